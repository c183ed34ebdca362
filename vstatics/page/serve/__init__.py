"""Page of a case on loopback, with fields for its numbers, updated when its file is saved.

A state of the page is the case calculated from certain texts of its documents. `states` stores the
latest states, tries changed numbers and saves them; its caller supplies the function that
calculates a case. `document_fields` finds the numbers in the documents, `number_fields` draws a
field and a slider for each, and `watched_files` detects files that another program has changed.
`page` writes the page and its sections. `awaited` contains placeholders for pictures and slow
sections, which `studio` draws in another process when they become visible. `server` handles
connections: `connections` limits them, `requests` reads and checks requests, and `answers` contains
the responses. In the browser, `serve.js` requests states, shows, tries and saves them, and
`patches.js` updates the numbers of the page.
"""
