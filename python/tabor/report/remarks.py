"""Warnings of a result: doubts, which change a number, and information, which says what was asked for and done."""

from tabor.report import hdf


class Information(str):
    """A line of the class "information"; any other text is a doubt."""


def of_file(facts):
    """The lines of the root attribute `warnings`, each of the class that the file gives it; of older files all are doubts."""
    lines, classes = hdf.text_list(facts.get("warnings")), hdf.text_list(facts.get("warning_classes"))
    if len(classes) != len(lines):
        return lines
    return [Information(line) if kind == "information" else line for line, kind in zip(lines, classes)]


def parted(lines):
    """(doubts, information), each in its order."""
    told = [line for line in lines if isinstance(line, Information)]
    return [line for line in lines if not isinstance(line, Information)], told
