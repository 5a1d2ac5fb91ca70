"""Figures and one self-contained HTML page from tabor's result files (schema: docs/results.md)."""
