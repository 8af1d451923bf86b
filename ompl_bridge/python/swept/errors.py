# SPDX-License-Identifier: BSD-3-Clause
"""What swept raises and warns of. Texts are those of the C++ library, unchanged."""


class Error(Exception):
    """Base of all exceptions of swept."""


class ArgumentError(Error, ValueError):
    """An argument whose value cannot be used: a shape, an order in memory, a name, a number."""


class ArgumentTypeError(Error, TypeError):
    """An argument of a type that cannot be used, such as an array of float32."""


class InputError(Error):
    """A file that cannot be used: `file:line: error: message`."""

    file: str = ""  #: the file, as it was given
    line: int = 0  #: counts from 1; 0: the file as a whole
    message: str = ""  #: what is wrong, without file and line


class UsageError(Error):
    """A request that cannot be fulfilled although no input file is at fault."""


class Cancelled(Error):
    """A token was cancelled, or the time was up, before the work was done."""


class InputWarning(UserWarning):
    """A remark about a file: `file:line: warning: message`."""
