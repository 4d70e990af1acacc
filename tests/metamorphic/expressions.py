# SPDX-License-Identifier: BSD-3-Clause
"""Expressions of scenes as text: names are replaced, nothing is simplified."""
import math
import re

TOKEN = re.compile(r"(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|(?P<name>[A-Za-z_][A-Za-z0-9_]*)|(?P<other>.)", re.S)
BRACES = re.compile(r"\$\{([^}]*)\}")


def tokens(text):
    """(kind, text) of each token; kind is number, name or other."""
    return [(match.lastgroup, match.group()) for match in TOKEN.finditer(BRACES.sub(r" \1 ", text))]


def substitute(text, replacements):
    """Replaces names, all at once: what comes in is not looked at again."""
    return "".join(replacements.get(part, part) if kind == "name" else part for kind, part in tokens(text))


def names(text):
    """The names in an expression."""
    return {part for kind, part in tokens(text) if kind == "name"}


def times(text, factor):
    """The expression times a constant."""
    if factor == 1:
        return text
    if factor == -1:
        return f"-({text})"
    return f"({text})*{number(factor)}"


def number(value):
    """A constant as text; in parentheses where a sign would meet an operator."""
    text = repr(float(value))
    if text.endswith(".0"):
        text = text[:-2]
    return f"({text})" if text.startswith("-") else text


def _operand_end(parts, at):
    """Behind the operand of a comparison that starts at `at`: it ends at what separates operands."""
    depth = 0
    while at < len(parts):
        part = parts[at][1]
        if depth == 0 and part in "?:,&|)":
            break
        depth += (part == "(") - (part == ")")
        at += 1
    return at


def stretch_time(text, factor, start):
    """t of the old scene in terms of that of the new one, t' = factor t + start.

    Seam hits times exactly with which t is compared, and finds them by the text `t < X`: so it is X that is
    changed where t stands alone on the left of a comparison or first in min and max.
    """
    if factor == 1 and start == 0:
        return text
    parts = [part for part in tokens(text) if not part[1].isspace()]
    old = "t" if start == 0 else f"(t - {number(start)})"
    old = old if factor == 1 else f"({old}/{number(factor)})"

    def later(operand):
        operand = "".join(part for _, part in operand)
        result = operand if factor == 1 else f"({operand})*{number(factor)}"
        return result if start == 0 else f"({result} + {number(start)})"

    result, at = [], 0
    while at < len(parts):
        kind, part = parts[at]
        following = parts[at + 1][1] if at + 1 < len(parts) else ""
        if kind == "name" and part in ("min", "max") and [p for _, p in parts[at + 1:at + 4]] == ["(", "t", ","]:
            end = _operand_end(parts, at + 4)
            extremum = f"{part}(t, {later(parts[at + 4:end])})"
            shifted = extremum if start == 0 else f"({extremum} - {number(start)})"
            result.append(shifted if factor == 1 else f"({shifted}/{number(factor)})")
            at = end + 1
        elif kind == "name" and part == "t" and following in ("<", ">"):
            first = at + 3 if at + 2 < len(parts) and parts[at + 2][1] == "=" else at + 2
            end = _operand_end(parts, first)
            result.append("t " + "".join(p for _, p in parts[at + 1:first]) + " " + later(parts[first:end]) + " ")
            at = end
        else:
            result.append(old if kind == "name" and part == "t" else part)
            at += 1
    return "".join(result)


FUNCTIONS = {name: getattr(math, name) for name in ("sin", "cos", "tan", "exp", "log", "sqrt", "atan", "asin", "acos", "tanh")}
FUNCTIONS |= {"abs": abs, "min": min, "max": max, "pi": math.pi, "rint": lambda x: float(math.floor(x + 0.5))}


def evaluate(text, parameters):
    """The value of a constant, an expression of parameters."""
    plain = BRACES.sub(r" \1 ", str(text)).replace("^", "**").replace("&&", " and ").replace("||", " or ")
    if plain.strip() == ".inf":
        return math.inf
    if "?" in plain:
        condition, rest = plain.split("?", 1)
        yes, no = rest.split(":", 1)
        return evaluate(yes if evaluate(condition, parameters) else no, parameters)
    return float(eval(plain, {"__builtins__": {}}, FUNCTIONS | parameters))  # scenes of this repository only


def fold(text, parameters):
    """Puts the values of parameters in the place of their names."""
    return substitute(text, {name: number(value) for name, value in parameters.items()})
