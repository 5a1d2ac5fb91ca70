"""Short names of files: what tells them apart, as a page has it in titles, legends and tables, and in the names of files."""

import re
from collections import Counter

_EXTENSIONS = re.compile(r"(\.[A-Za-z][A-Za-z0-9]{0,7}){1,2}$")  # "1.5um" has none: it begins with a digit


def short(files):
    """{file: its name without folder and extension, or with as much of them as tells it from the others}"""
    files = list(dict.fromkeys(files))
    forms = {file: _forms(file) for file in files}
    found, open_files = {}, files
    for level in range(max((len(of_file) for of_file in forms.values()), default=0)):
        level_forms = {file: of_file[min(level, len(of_file) - 1)] for file, of_file in forms.items()}
        counts = Counter(level_forms.values())
        taken = set(found.values())
        found.update({file: form for file in open_files if counts[form := level_forms[file]] == 1 and form not in taken})
        open_files = [file for file in open_files if file not in found]
    return {file: found.get(file, file) for file in files}


def in_files(texts):
    """What each text is in the name of a file; of two that would be the same there, and of nothing, with its place."""
    forms = [in_a_file(text) for text in texts]
    counts = Counter(form.casefold() for form in forms)
    return [form if form and counts[form.casefold()] == 1 else f"{form}_{place:04d}".lstrip("_") for place, form in enumerate(forms)]


def in_a_file(text):
    """'before 1 (side A)' -> 'before_1_side_A'"""
    return re.sub(r"[^\w.-]+", "_", text).strip("_.-")


def of_state(label):
    """What tells states apart, in the name of a file: 'P = 7 MPa, 0.45 g/m²' -> '7MPa_0.45g_per_m2'."""
    words = label.replace("P = ", "").replace(", ", "_").replace(" (", "_").replace("/", "_per_").replace("²", "2").replace("µ", "u")
    return "".join(letter for letter in words if letter.isascii() and (letter.isalnum() or letter in "._-"))


def _forms(file):
    """From short to long: without and with the extension, then a folder more each time; at last as it is."""
    parts = [part for part in re.split(r"[/\\]", file) if part]
    forms = []
    for first in reversed(range(len(parts))):
        name = "/".join(parts[first:])
        forms += [_EXTENSIONS.sub("", name) or name, name]
    return [*forms, file]
