"""What can go wrong, each with the exit code of tabor's command line."""


class ReportError(Exception):
    exit_code = 1


class UsageError(ReportError):
    """An option that the result has no use for."""

    exit_code = 2


class InputError(ReportError):
    """A file that cannot be read or is invalid, or a Python package that is absent."""

    exit_code = 3


class OutputError(ReportError):
    """A figure, table or page that cannot be written."""

    exit_code = 5


def readable(text):
    """The text with bytes that are not UTF-8 as \\xff, so that it can be written and drawn."""
    return str(text).encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace")


def printable(text):
    """The same in one line that a terminal may get: characters it acts upon or nobody sees are escaped."""
    return "".join(
        letter if letter.isprintable() else f"\\x{ord(letter):02x}" if ord(letter) < 128 else f"\\u{{{ord(letter):x}}}"
        for letter in readable(text)
    )
