"""Executes a notebook as nbconvert would: nobody is there to be asked, and errors do not end it.

    execute.py NOTEBOOK EXECUTED
"""

import sys

import nbclient
import nbformat


def main(source, target):
    notebook = nbformat.read(source, as_version=4)
    nbformat.validate(notebook)
    client = nbclient.NotebookClient(notebook, timeout=600, allow_errors=True)
    client.execute()
    nbformat.validate(notebook)
    nbformat.write(notebook, target)


if __name__ == "__main__":
    main(*sys.argv[1:])
