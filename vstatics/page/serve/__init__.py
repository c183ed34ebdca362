"""The page of a case on loopback, made anew when its file is saved, with fields for its numbers.

Whoever opens files tells how a case is calculated from texts of its documents. `document_fields`
finds the numbers in these, `awaited` has what stands in place of pictures until they are looked
at, `page` makes the page and its sections of what is calculated, `states` keeps what was shown,
tries and saves, `watched_files` tells whether others did; `studio` makes what is awaited, in
another process. In the browser `serve.js` asks, tries, saves and shows, and `patches.js` writes
numbers into the elements that have others. `requests` reads what a browser sends, and refuses
what no page of ours does; `answers` are what it gets; `connections` bounds them; `server` brings
all together.
"""
