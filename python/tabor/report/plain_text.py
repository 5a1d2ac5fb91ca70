"""Labels with formulas between dollar signs, as plain text."""

import re

_RAISED = str.maketrans("0123456789+-D", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻ᴰ")
_LOWERED = dict(zip("0123456789aehijklmnoprstuvx", "₀₁₂₃₄₅₆₇₈₉ₐₑₕᵢⱼₖₗₘₙₒₚᵣₛₜᵤᵥₓ"))


def plain(text):
    """'$A_{real}$' -> 'Aᵣₑₐₗ', in one line."""
    text = text.replace(r"\$", "\0")
    text = re.sub(r"\$([^$]*)\$", lambda match: _formula(match.group(1)), text)
    return text.replace("\0", "$").replace("\n", " ")


def _formula(text):
    text = text.replace("\\mu", "μ").replace("\\tau", "τ").replace("\\,", " ")
    text = re.sub(r"_\{([^}]*)\}|_(.)", lambda match: _lowered(match.group(1) or match.group(2)), text)
    return re.sub(r"\^\{([^}]*)\}|\^(.)", lambda match: (match.group(1) or match.group(2)).translate(_RAISED), text)


def _lowered(text):
    return "".join(_LOWERED[letter] for letter in text) if set(text) <= set(_LOWERED) else "_" + text
