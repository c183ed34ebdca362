"""Explanations of all messages: cause, remedy, and a case that shows the message.

The folder `causes` has a file for the core and for each annex. There each id has three lines,
followed by an empty line: the id, the cause, and the remedy, both in whole sentences. The folder
`examples` has a case for each message that a single case can cause. `catalogue` reads both folders
for `vstatics check --explain` and for the site.
"""
