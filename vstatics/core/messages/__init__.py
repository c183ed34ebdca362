"""Explanations of all messages: cause, remedy, and a case that shows the message.

The folder `causes` has a file for the core and for each annex. Each id has three lines there,
followed by an empty line: the id, the cause, and the remedy, both in whole sentences. The folder
`examples` has a case for each message that a case alone can show. `catalogue` reads both for
`vstatics check --explain` and for the site.
"""
