"""A study folder as `tabor sweep` leaves it: tables in memory, maps read when asked for."""

from dataclasses import dataclass, field
from pathlib import Path

from tabor.report import columns, density_curves, guard, hdf, names, remarks
from tabor.report.columns import Columns
from tabor.report.errors import InputError, readable
from tabor.report.states import Film, Flow, StudyContact
from tabor.report.table import Table


_DENSITY_COLUMNS = tuple(f"friction_lubricated_{kind}" for kind in ("mean", "std", "sem")) + ("n",)


@dataclass
class Scan:
    """One row of /scans. Lengths [m], sides [pixels]."""

    node: object
    index: int
    facts: dict
    warnings: list
    name: str = ""  # short, on the page

    @property
    def file(self):
        return self.facts.get("file", f"scan {self.index}")

    @property
    def group(self):
        return self.facts.get("group", "")

    @property
    def is_treated(self):
        """Whether the store held its surface when the tables were written."""
        return all(name in self.facts for name in ("pixel_x_m", "pixel_y_m", "nx", "ny"))

    @property
    def pixel(self):
        """(x, y) [m]"""
        return self.facts["pixel_x_m"], self.facts["pixel_y_m"]

    @property
    def treatment(self):
        return hdf.text_list(self.facts.get("treatment"))

    @property
    def steps(self):
        """The treatment without what its steps say of this scan: 'level=plane' of 'level=plane: 9 points, ...'."""
        return [text.split(": ", 1)[0] for text in self.treatment]

    @property
    def surface_warnings(self):
        return hdf.text_list(self.facts.get("doubts"))

    def height(self):
        """[m], shape (ny, nx), NaN = hole; None if the store lost it."""
        surface = self._linked(self.node, "surface")
        return None if surface is None else surface["height"][()]

    def psd(self):
        return self._linked(self.node, "psd")

    def contacts(self):
        """By rising pressure; none while there is no surface to draw them on."""
        found = [StudyContact(node) for node in self._linked_members("contact")]
        return sorted(found, key=lambda contact: contact.pressure)

    def films(self):
        """By rising density."""
        found = [Film(node) for node in self._linked_members("films")]
        return sorted(found, key=lambda film: film.density)

    def flows(self):
        """States whose oil flows, in the order of the study."""
        return [Flow(node) for node in self._linked_members("fluid")]

    def _linked_members(self, name):
        folder = hdf.child(self.node, name)
        if folder is None or not self.is_treated:
            return []
        guard.try_together(hdf.linked_files(folder))
        members = [self._linked(folder, key) for key in sorted(folder)]
        return [member for member in members if member is not None]

    def _linked(self, group, name):
        node = hdf.child(group, name)
        if node is None and name in group.keys():
            self._warn(
                f"{self.file}: {hdf.link_target(group, name)} is missing or damaged; "
                "what is drawn from it is left out"
            )
        return node

    def _warn(self, message):
        if message not in self.warnings:
            self.warnings.append(message)


@dataclass
class Study:
    path: Path
    file: object
    facts: dict
    table: Table
    averages: Table
    scans: list
    experiment: Table
    density_averages: Table  # empty where a study has none
    density_places: density_curves.Places
    column: Columns  # what its numbers are called
    slides: Table = field(default_factory=lambda: Table({}))  # states of its slides, where sheets slide
    warnings: list = field(default_factory=list)

    kind = "study"

    @property
    def title(self):
        return readable(self.facts.get("title") or self.path.parent.resolve().name)

    @property
    def names(self):
        """{file of a scan: its short name}"""
        return names.short([scan.file for scan in self.scans] + list(self.table.get("scan", [])))

    @property
    def saturation_pressure(self):
        """[Pa], None if elastic."""
        return self.facts.get("saturation_pressure_Pa")

    @property
    def answers(self):
        """(short, all): what friction against density says; nothing where a table says it of each pressure."""
        return ([], []) if self.places else density_curves.answers(self.facts, self.density_averages)

    @property
    def places(self):
        """The table of where densities lie on the mean curves; None in older files."""
        return density_curves.places_table(self.density_places, group_names=len(self.groups) > 1)

    @property
    def groups(self):
        """In the order of the study."""
        named = [scan.group for scan in self.scans] + list(self.averages.get("group", []))
        return list(dict.fromkeys(named))


def load(path, file):
    """Reads tables and scan facts of an open results.h5; raises InputError if it is no study."""
    facts = hdf.attributes(file)
    warnings = []
    study = Study(
        path=path,
        file=file,
        facts=facts,
        table=_table(path, file, "table"),
        averages=_table(path, file, "averages"),
        scans=_scans(path, file, warnings),
        experiment=_experiment(file),
        density_averages=density_curves.load(file, "density_averages", _DENSITY_COLUMNS, warnings),
        density_places=density_curves.load_places(file, warnings),
        column=columns.of_file(file),
        slides=Table(hdf.columns(file["slides"])) if "slides" in file else Table({}),
        warnings=warnings,
    )
    study.warnings.extend(list(_warnings_about(study)))
    return study


def _table(path, file, name):
    if name not in file:
        raise InputError(
            f"{path}: /{name} is missing; run `tabor sweep` again, it rebuilds the tables from the store"
        )
    return Table(hdf.columns(file[name]))


def _scans(path, file, warnings):
    if "scans" not in file:
        return []
    folder = file["scans"]
    scans = [Scan(folder[key], index, hdf.attributes(folder[key]), warnings) for index, key in enumerate(sorted(folder))]
    _name(scans)
    return scans


def _name(scans):
    """Of a scan that is there twice the group tells which."""
    files, short = [scan.file for scan in scans], names.short(scan.file for scan in scans)
    for scan in scans:
        is_twice = files.count(scan.file) > 1 and scan.group
        scan.name = readable(f"{short[scan.file]} ({scan.group})" if is_twice else short[scan.file])


def _experiment(file):
    return Table(hdf.columns(file["experiment"])) if "experiment" in file else Table({})


def _warnings_about(study):
    expected, done = study.facts.get("n_cases"), study.facts.get("n_cases_done")
    if expected is not None and done is not None and done < expected:
        yield f"The study is not complete: {done} of {expected} cases are done. Averages hold what is there."
    loose = study.table.not_converged()
    if loose:
        yield (
            f"{loose} of {len(study.table)} rows did not converge. They are marked in the table and in the "
            "figures and count in no average."
        )
    for message in dict.fromkeys(text for text in study.table.get("error", ()) if text):
        yield f"Failed: {message}"
    if "warnings" in study.facts:  # each once, with its cases
        yield from remarks.of_file(study.facts)
        return
    for scan in study.scans:
        for warning in dict.fromkeys(scan.surface_warnings + _warnings_of_states(scan)):
            yield f"{scan.file}: {warning}"


def _warnings_of_states(scan):
    states = [*scan.contacts(), *scan.films()]
    found = [text for state in states for text in hdf.text_list(state.facts.get("warnings"))]
    return found + [
        f"{flow.label}: {text}" for flow in scan.flows() for text in hdf.text_list(flow.facts.get("warnings"))
    ]
