#!/usr/bin/python3
"""The report: the sections of all studies on one page, with their pictures made small.

Every study leaves out/NAME/section.html (verification/common/page.py). This puts those that are there on one page,
index.html in the folder OUTPUT, with a list of contents, and copies their pictures beside it with 64 colours. Exit
status 1 if a study has no section yet, a section names a picture that is missing, or the pictures exceed 3 MB.
"""

import argparse
import html
import re
import shutil
import sys
from datetime import date
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "verification/common"))

import figure
import page

STUDIES = ["exact", "crosscheck", "preprint", "chart", "stability", "accuracy"]  # below out/, each made by ./dev NAME
MOST_BYTES = 3_000_000
PICTURE = re.compile(r'<img src="([^"]+)"')


class ReportError(Exception):
    """What is missing or too large."""


def body_of(section):
    """The section's own HTML, without the head that makes it a page by itself."""
    text = section.read_text()
    start = text.find("<section")
    if start < 0:
        raise ReportError(f"{section}: no <section> in it; expected what page.write_section writes")
    return text[start:]


def take_section(folder, name, output):
    """The HTML of a study's section for the page in `output`, its pictures copied there."""
    section = folder / name / "section.html"
    if not section.is_file():
        raise ReportError(f"{section} is missing: ./dev {name} writes it")

    def moved(match):
        source = section.parent / html.unescape(match[1])
        if not source.is_file():
            raise ReportError(f"{section}: the picture {match[1]} is missing")
        target = Path(name) / Path(html.unescape(match[1]))
        figure.copy_small(source, output / target)
        return f'<img loading="lazy" src="{html.escape(str(target))}"'

    return PICTURE.sub(moved, body_of(section))


def contents(sections):
    """Links to the sections by their ids and titles."""
    lines = []
    for text in sections:
        identity, title = re.search(r'<section id="([^"]+)">', text), re.search(r"<h2>(.*?)</h2>", text)
        lines.append(f'<li><a href="#{identity[1]}">{title[1]}</a></li>')
    return "<ul>\n" + "\n".join(lines) + "\n</ul>\n"


def assemble(folder, studies, output):
    """Writes output/index.html; returns the bytes of everything in it."""
    if output.exists():
        shutil.rmtree(output)
    output.mkdir(parents=True)
    sections = [take_section(folder, name, output) for name in studies]
    head = f'<meta charset="utf-8"><title>mortise: report</title><style>{page.STYLE}</style>'
    intro = f"<h1>mortise: what it is held against</h1>\n{page.paragraph(f'Made on {date.today().isoformat()}.')}"
    text = f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head>\n<body>\n{intro}{contents(sections)}'
    (output / "index.html").write_text(text + "".join(sections) + "</body></html>\n")
    return sum(path.stat().st_size for path in output.rglob("*") if path.is_file())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-i", "--input", type=Path, default=ROOT / "out", help="folder of the studies (default: out)")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "docs/report", help="default: docs/report")
    parser.add_argument("--only", nargs="+", default=STUDIES, metavar="NAME", help=f"default: {' '.join(STUDIES)}")
    arguments = parser.parse_args()
    try:
        size = assemble(arguments.input, arguments.only, arguments.output)
        if size > MOST_BYTES:
            raise ReportError(f"the report has {size} bytes; expected at most {MOST_BYTES}")
    except ReportError as error:
        print(f"report: error: {error}", file=sys.stderr)
        return 1
    print(f"{arguments.output / 'index.html'}: {size / 1e6:.2f} MB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
