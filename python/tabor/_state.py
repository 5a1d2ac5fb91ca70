"""All of a surface but its heights as attributes that every file of NetCDF takes, and back."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any


def attributes_of(state: tuple[Any, ...]) -> dict[str, Any]:
    """Attributes of the state of a Topography: texts and numbers, lists as lines or JSON; what is empty is left out."""
    _, _, periodic, tiles, (source, file_format, instrument, channel), metadata, history, doubts, (edges, edges_match) = state
    found: dict[str, Any] = {
        "source": source, "format": file_format, "instrument": instrument, "channel": channel,
        "history": "\n".join(history), "edges": edges or "",
        "metadata": json.dumps(dict(metadata)) if metadata else "", "doubts": json.dumps([list(one) for one in doubts])}
    numbers = {"periodic": int(periodic), "edges_match": int(edges_match), "tiles": float(tiles)}
    return {**{key: text for key, text in found.items() if text}, **numbers}


def state_of(attributes: Mapping[str, Any], plain: tuple[Any, ...]) -> tuple[Any, ...] | None:
    """The state that ``attributes_of`` made these of, on the grid of ``plain``; None for attributes of others."""
    if not {"periodic", "edges_match", "tiles", "doubts", "source"} <= attributes.keys():
        return None
    names = tuple(str(attributes.get(key, "")) for key in ("source", "format", "instrument", "channel"))
    edges = str(attributes.get("edges", "")) or None
    history = str(attributes.get("history", ""))
    try:
        metadata = json.loads(attributes.get("metadata", "{}"))
        doubts = [tuple(one) for one in json.loads(attributes["doubts"])]
    except ValueError as error:
        raise ValueError(f"array: its attributes are not those that to_xarray wrote: {error}") from error
    return (*plain[:2], bool(attributes["periodic"]), float(attributes["tiles"]), names, metadata,
            history.split("\n") if history else [], doubts, (edges, bool(attributes["edges_match"])))
