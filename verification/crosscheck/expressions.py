"""Functions of place of a scene, in FreeFEM's language instead of muParser's (docs/files.md)."""

import re

from cases import StudyError

TOKEN = re.compile(r"\s*(?:(\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?)|([A-Za-z_]\w*)|(&&|\|\||[<>=!]=|[-+*/^<>?:(),]))")
PLACES = {"x": "px", "y": "py", "r": "sqrt(px^2. + py^2.)", "theta": "atan2(py, px)", "pi": "pi"}
FUNCTIONS = {
    "ln": "log", "rint": "rint", "min": "min", "max": "max", "log10": "log10", "sqrt": "sqrt", "abs": "abs", "exp": "exp",
    **{f"{arc}{name}{hyperbolic}": f"{arc}{name}{hyperbolic}"
       for arc in ("", "a") for name in ("sin", "cos", "tan") for hyperbolic in ("", "h")},
    "atan2": "atan2",
}  # fmt: skip


def translate(text):
    """The expression as FreeFEM code of the place (px, py). Operators bind alike in both, `-2^2` is -4 and `2^3^2` is 512;
    but in FreeFEM 1 / 2 is 0, and so numbers become real ones. StudyError, with the name, where FreeFEM has no such."""
    words, at = [], 0
    while text[at:].strip():
        found = TOKEN.match(text, at)
        if not found:
            raise StudyError(f"'{text}': cannot read '{text[at:].strip()[:10]}'")
        number, name, operator = found.groups()
        at = found.end()
        called = text[at:].lstrip().startswith("(")
        if number:
            words.append(repr(float(number)))
        elif name and name not in (FUNCTIONS if called else PLACES):
            raise StudyError(f"'{text}': FreeFEM is not told what '{name}' is; known: {', '.join([*PLACES, *FUNCTIONS])}")
        else:
            words.append(operator or (FUNCTIONS[name] if called else f"({PLACES[name]})"))
    return " ".join(words)


class Quantities:
    """Values of a case file: numbers as they are, expressions as f0, f1, ... and their code."""

    def __init__(self):
        self.code = []

    def word(self, value, factor=1.0):
        """Of a number or an expression, times a factor."""
        if not isinstance(value, str):
            return repr(float(value) * factor)
        code = f"{factor!r} * ({translate(value)})"
        if code not in self.code:
            self.code.append(code)
        return f"f{self.code.index(code)}"

    def script(self):
        """What FreeFEM includes before elasticity.idp."""
        lines = [f"  if (k == {k}) return {code};" for k, code in enumerate(self.code)]
        head = ["macro givenExpressions() 1 //", "func real expression(int k, real px, real py) {"]
        return "\n".join([*head, *lines, "  return 0.;", "}"]) + "\n"
