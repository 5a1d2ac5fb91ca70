"""Wraps the prose of Markdown at 100 columns. Tables, code, headings and equations stay as they are.

usage: tools/markdown_lines.py FILE...      rewrites the files in which a paragraph has a longer line"""

import pathlib
import re
import sys

WIDTH = 100
FENCE = re.compile(r"^\s*(```|~~~|\$\$|:::)")
MARKER = re.compile(r"^(\s*)([-*+]|\d+[.)])(\s+)(?=\S)")
# A line that begins so would be a list, a heading, a quotation, a table or an underline.
NO_BEGIN = re.compile(r"^([-*+>|#=:~]|\d+[.)]$|\$\$|```)")
SPAN = re.compile(r"(`+)(?:(?!\1).)*\1")  # code keeps its spaces
NO_BREAK = "\x00"


def _words(text):
    hidden = SPAN.sub(lambda span: span.group().replace(" ", NO_BREAK), text)
    words = []
    for word in hidden.split():
        if words and NO_BEGIN.match(word):
            words[-1] += " " + word
        else:
            words.append(word)
    return [word.replace(NO_BREAK, " ") for word in words]


def _wrapped(lines, width):
    """One paragraph, or one entry of a list: its first line may have the marker of the list."""
    marker = MARKER.match(lines[0])
    first = marker.group() if marker else re.match(r"\s*", lines[0]).group()
    rest = " " * len(first) if marker else first
    text = " ".join([lines[0][len(first):].strip(), *(line.strip() for line in lines[1:])])
    result, current = [], ""
    for word in _words(text):
        indent = rest if result else first
        if current and len(indent) + len(current) + 1 + len(word) > width:
            result.append(indent + current)
            current = word
        else:
            current = f"{current} {word}" if current else word
    return [*result, (rest if result else first) + current]


def _is_prose(line, before):
    """True where a line begins or continues a paragraph that can be wrapped."""
    if not line.strip() or re.match(r"^\s*(\||#|<|>|!\[|\[\^|---|===)", line):
        return False
    return bool(before) or bool(MARKER.match(line)) or not line.startswith("    ")


def paragraphs(text):
    """Yields (is prose, lines) of a text, in order; together they are the text."""
    block, fence, is_list, front = [], None, False, text.startswith("---\n")
    for number, line in enumerate(text.split("\n")):
        mark = FENCE.match(line)
        if front:
            front = not (number and line == "---")
            yield False, [line]
            continue
        if fence or mark:
            if block:
                yield True, block
                block = []
            ends = mark and (not fence or mark.group(1) == fence) and not (
                not fence and line.strip() != "$$" and line.count("$$") == 2)
            if ends:
                fence = None if fence else mark.group(1)
            yield False, [line]
            continue
        marker = MARKER.match(line)
        indented = line.startswith("    ")
        if not line.strip():
            prose = False
        elif indented and not block and not is_list:
            prose = False  # code
        else:
            prose = _is_prose(line, block)
        if line.strip() and not line.startswith(" "):
            is_list = bool(marker) or (is_list and bool(block))
        if block and (not prose or marker):
            yield True, block
            block = []
        if prose:
            block.append(line)
        else:
            yield False, [line]
    if block:
        yield True, block


def wrapped(text, width=WIDTH):
    """The text with every paragraph wrapped that has a longer line than `width`; the others stay."""
    result = []
    for is_prose, lines in paragraphs(text):
        breaks = any(line.endswith(("  ", "\\")) for line in lines)
        if is_prose and not breaks and any(len(line) > width for line in lines):
            lines = _wrapped(lines, width)
        result.extend(lines)
    return "\n".join(result)


def main():
    for path in map(pathlib.Path, sys.argv[1:]):
        text = path.read_text("utf-8")
        if wrapped(text) != text:
            path.write_text(wrapped(text), "utf-8")


if __name__ == "__main__":
    main()
