"""What can go wrong, each with the exit code of tabor's command line."""


class ReportError(Exception):
    exit_code = 1


class InputError(ReportError):
    """A file that cannot be read or makes no sense, or a Python package that is absent."""

    exit_code = 3


class OutputError(ReportError):
    """A figure, table or page that cannot be written."""

    exit_code = 5
