"""The table of compare.py as text, and the section "Peers" of docs/benchmarks.md."""

from __future__ import annotations

import re
import statistics

COLUMNS = ("tool", "option", "surface", "n", "contact", "gap reached", "area error", "seconds",
           "peak MB", "ratio to tabor")
HEAD = "| " + " | ".join(COLUMNS) + " |\n" + "|---" * len(COLUMNS) + "|"
TOOLS = ("tabor", "ASPHER", "Tamaas", "ContactMechanics", "slippy")


def key(row: dict) -> tuple:
    return row["surface"], row["n"], row["case"], row["tool"], row["option"]


def order(row: dict) -> tuple:
    saturated = row["case"].startswith("saturated")
    return (row["n"], row["surface"], saturated, float(re.findall(r"[\d.]+", row["case"])[0]),
            TOOLS.index(row["tool"]), row["option"])


def reached(row: dict) -> bool:
    return "processor_seconds" in row and "note" not in row


def ratio(row: dict, rows: list[dict]) -> float | None:
    ours = [r for r in rows if r["tool"] == "tabor" and key(r)[:3] == key(row)[:3]]
    if not (ours and reached(row) and reached(ours[0])):
        return None
    return row["processor_seconds"] / ours[0]["processor_seconds"]


def line(row: dict, rows: list[dict]) -> str:
    cells = [row["tool"], row["option"], row["surface"], str(row["n"]), row["case"]]
    if "certificate" in row and row["certificate"] is not None:
        of_tabor = ratio(row, rows)
        shifted = " (load shifted)" if abs(row["load_error"]) > 1e-10 else ""
        cells += [f"{row['certificate']:.1e}{shifted}", f"{row['area_error']:.0e}",
                  f"{row['processor_seconds']:.2f}", f"{row['peak_bytes'] / 1e6:.0f}",
                  f"{of_tabor:.1f}" if of_tabor else row.get("note", "")]
    else:
        cells += ["", "", "", "", row.get("note", "")]
    return "| " + " | ".join(cells) + " |"


def best_rows(record: dict) -> list[dict]:
    """Of every tool the option that met the target in the least time, else the first."""
    best: dict[tuple, dict] = {}
    for row in sorted(record["rows"], key=order):
        known = best.get(key(row)[:4])
        if known is None or (reached(row) and (
                not reached(known) or row["processor_seconds"] < known["processor_seconds"])):
            best[key(row)[:4]] = row
    return list(best.values())


def summary(rows: list[dict]) -> str:
    """Smallest, median and largest ratio to tabor of every tool, kind of contact and size."""
    text = ("| tool | contact | n | cases | smallest ratio | median | largest | no result |\n"
            "|---|---|---|---|---|---|---|---|\n")
    groups: dict[tuple, list[dict]] = {}
    for row in rows:
        kind = "saturated" if row["case"].startswith("saturated") else "elastic"
        groups.setdefault((TOOLS.index(row["tool"]), kind, row["n"]), []).append(row)
    for (tool, kind, n), group in sorted(groups.items()):
        ratios = sorted(r for r in (ratio(row, rows) for row in group) if r is not None)
        if tool and ratios:
            text += (f"| {TOOLS[tool]} | {kind} | {n} | {len(group)} | {ratios[0]:.1f} | "
                     f"{statistics.median(ratios):.1f} | {ratios[-1]:.1f} | "
                     f"{len(group) - len(ratios)} |\n")
    return text


def section(record: dict) -> str:
    """The section of docs/benchmarks.md."""
    rows = best_rows(record)
    versions = ", ".join(f"{name} {version}" for name, version in record["versions"].items())
    rejected = "".join(f"- {tool}: {reason}.\n" for tool, reason in record["refused"].items())
    return f"""Other open programs on the same contacts, each driven to the same proven error. Made by `{record['command']}` on {record['date']};
do not edit. It may have run in parts (`--tools`, `--surface`, `--cases`): a row's date is in `benchmarks_peers.json`, and tabor's
rows may be younger than its peers'. {record['machine']}, shared with other work; one thread for every program.
Versions: {versions}.

- **Gap reached**: the duality gap of [theory](theory.md), computed by `bench_certify` on the pressure field that a program returns. Each
  program's own tolerance is changed in steps of 3 until the gap is at most {record['target']:.0e}, and where that is possible not below
  a tenth of that. A field that does not carry the load to 1e-10 is first shifted, on its contact pixels, until it does ("load shifted").
- **Area error**: pixels in contact against tabor at a gap of 1e-10.
- **Seconds**: processor time of the solve call alone, without import and reading; where a program builds its operator within that
  call (tabor, ASPHER), that is in it. Median of three, one where a solve took more than 3 s; at most {record['timeout_s']} s.
- **Peak MB**: largest resident memory of the process, Python and imports included.
- **Contact**: mean pressures with which tabor finds 0.5, 2, 10 and 50 % of the pixels in contact (secant on a logarithmic scale, within
  2 % of that; they stand in `benchmarks_peers.json`); saturated: 2 and 10 MPa with p_sat = 240 MPa. E* is that of aluminium.
- **Surfaces**: self-affine with H = 0.8, rms slope 0.1, roll-off at a quarter of the side; EDT-like; seed 1; pixels of 0.67 um. Scans are
  cropped to 512 x 512, levelled by a plane, holes filled, and treated as periodic. Not every peer was run on every surface above
  n = 512: what is not in the table was not run.
- **Options**: of several options of a program the fastest that met the target is shown; above n = 512 only the one that was fastest at
  a smaller size was run. ASPHER is built with FFTW for this processor and solves on nested grids with its preconditioner;
  ContactMechanics runs with restarts (its default) and without; Tamaas solves for the pressure (slower for the gap, in a trial), in
  units of E* and the side, without which its saturated solver does not move.

What a program cannot do, or what it can and tabor cannot:

{rejected}- ContactMechanics: finds the saturated load only when it is started from the bearing area, as here.
- Tamaas, slippy: adhesion. Tamaas, ASPHER, slippy: friction within the contact. Tamaas: viscoelastic and plastic
  volumes. None of these is in tabor.

Ratios of processor time to tabor's:

{summary(rows)}
{HEAD}
""" + "".join(line(row, rows) + "\n" for row in rows)
