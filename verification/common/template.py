"""Pages from templates: prose stands in a Markdown file beside the study, Python fills in the numbers.

A template's fields are those of str.format ({name}, {name:.1e}; a brace itself is {{ or }}), and
  {name}               of None is "none", whatever the format
  {name:?this|that}    "this" where the value is true, else "that" (which may be empty); fields in both are filled in
A field without a value is an error, and so is a value without a field. A template may consist of several texts, each
under a line <!-- NAME -->.
"""

import re
import string


class TemplateError(Exception):
    """A field without a value, a value without a field, or a text that is not there."""


class Filler(string.Formatter):
    """One filling; remembers which values it has used."""

    def __init__(self):
        super().__init__()
        self.used = set()

    def get_value(self, key, args, kwargs):
        if key not in kwargs:
            raise TemplateError(f"the field {{{key}}} has no value; there are {', '.join(sorted(kwargs)) or 'none'}")
        self.used.add(key)
        return kwargs[key]

    def format_field(self, value, format_spec):
        if format_spec.startswith("?"):
            yes, _, no = format_spec[1:].partition("|")
            return yes if value else no
        return "none" if value is None else super().format_field(value, format_spec)


def fill(text, **values):
    """The text with its fields filled in."""
    filler = Filler()
    try:
        filled = filler.vformat(text, (), values)
    except (ValueError, TypeError, IndexError) as error:
        raise TemplateError(f"{error} in: {text[:200]}") from error
    unused = set(values) - filler.used
    if unused:
        raise TemplateError(f"no field for {', '.join(sorted(unused))} in: {text[:200]}")
    return filled


def texts(path):
    """{name: text} of a template file; what stands before the first <!-- NAME --> is ""."""
    pieces = re.split(r"^<!-- (.+?) -->\n", path.read_text(), flags=re.MULTILINE)
    return {name: text.strip() for name, text in zip(["", *pieces[1::2]], pieces[::2])}


def percent(value):
    return f"{100 * value:.2g} %"


def table(heading, rows):
    """A Markdown table; a pipe in a cell is escaped."""
    line = lambda cells: "| " + " | ".join(str(cell).replace("|", "\\|") for cell in cells) + " |"
    return "\n".join([line(heading), "|" + "---|" * len(heading), *map(line, rows)])
