"""The terminal's door: one verb, one file.

A verb is a module here with a function `command` whose annotated parameters (`typer.Argument`,
`typer.Option`) are its arguments and whose docstring is its help. Its module name is the verb, with
an underscore where the verb is a Python word (`import_`). It is listed in `main.VERBS`.

A verb raises `InputError` for bad input and lets every other exception pass: `main` turns both
into one line and the exit status. It may return an exit status other than 0.
"""
