"""The page of a case on loopback, updated when its file is saved, with fields for its numbers.

`states` calculates the case, keeps the latest states of the page, tries changed numbers and saves
them; the caller supplies the function that calculates a case from the texts of its documents.
`document_fields` finds the numbers in these texts, `number_fields` draws a field and a slider for
each, and `watched_files` detects files changed by another program. `page` writes the page and its
sections. `awaited` has placeholders of pictures and slow sections, which `studio` draws in another
process when they come into sight.

`server` handles connections: `connections` limits them, `requests` reads and checks requests,
`answers` has the responses. In the browser `serve.js` requests states and shows, tries and saves
them, and `patches.js` updates the numbers of the page.
"""
