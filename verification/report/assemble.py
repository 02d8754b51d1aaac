#!/usr/bin/python3
"""The report: what mortise is, then the sections of all studies on one page, with their pictures made small.

Every study leaves out/NAME/section.html (verification/common/page.py). This puts those that are there on one page,
index.html in the folder OUTPUT, after opening.md and beside a table of contents, and copies their pictures beside it with
64 colours. A study that has not left a section is taken from the report that is there. Exit status 1 if it is in neither, a
section names a picture that is missing, or the pictures exceed 3 MB.
"""

import argparse
import html
import itertools
import re
import shutil
import sys
from datetime import date
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "verification/common"))

import figure
import page

STUDIES = ["chart", "performance", "accuracy", "benchmarks", "exact", "crosscheck", "preprint", "stability"]  # below out/, each made by ./dev NAME
MOST_BYTES = 3_000_000
PICTURE = re.compile(r'<img (?:loading="lazy" )?src="([^"]+)"')
LINK = re.compile(r'<a href="([^"]*)">(.*?)</a>')
# Beside page.STYLE: the contents stay, at the left of a wide window, in short above a narrow one's text.
STYLE = """
html { scroll-padding-top: 5em }
body { max-width: none; margin: 0; padding: 0 }
main { padding: 1em; max-width: 1000px; margin: 0 auto }
nav { position: sticky; top: 0; z-index: 1; background: var(--page); border-bottom: 1px solid var(--line); padding: 0.4em 1em;
  font-size: 13px }
nav ul { list-style: none; padding: 0; margin: 0; max-width: none } nav > ul { display: flex; flex-wrap: wrap; gap: 0 1.2em }
nav ul ul { display: none }
@media (min-width: 1250px) {
  html { scroll-padding-top: 0 }
  body { display: grid; grid-template-columns: 250px minmax(0, 1fr) }
  nav { height: 100vh; overflow-y: auto; box-sizing: border-box; border: 0; border-right: 1px solid var(--line) }
  nav > ul, nav ul ul { display: block } nav ul ul { padding: 0.1em 0 0.5em 0.8em }
  main { margin: 0; padding-left: 2em }
}
"""


class ReportError(Exception):
    """What is missing or too large."""


def body_of(section):
    """The section's own HTML, without the head that makes it a page by itself."""
    text = section.read_text()
    start = text.find("<section")
    if start < 0:
        raise ReportError(f"{section}: no <section> in it; expected what page.write_section writes")
    return text[start:]


def kept(name, report):
    """The section of a study in the report that is there, or none."""
    index = report / "index.html"
    text = index.read_text() if index.is_file() else ""
    found = re.search(rf'<section id="{name}">.*?</section>\n', text, re.DOTALL)
    return found[0] if found else None


def source(folder, name, report):
    """The HTML of a study's section, and the folder in which its pictures are."""
    section = folder / name / "section.html"
    if section.is_file():
        return body_of(section), section.parent
    text = kept(name, report)
    if text is None:
        raise ReportError(f"{section} is missing: ./dev {name} writes it")
    print(f"{name}: as it was in {report / 'index.html'}")
    return text, report


def take_section(text, pictures, name, output):
    """The section for the page in `output`, its pictures copied there. Links to what is not there are texts."""

    def moved(match):
        path = Path(html.unescape(match[1]))
        if not (pictures / path).is_file():
            raise ReportError(f"{name}: the picture {pictures / path} is missing")
        target = path if path.parts[0] == name else Path(name) / path
        if (pictures / "index.html").is_file():  # of a report: small as it is
            (output / target).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(pictures / path, output / target)
        else:
            figure.copy_small(pictures / path, output / target)
        return f'<img loading="lazy" src="{html.escape(str(target))}"'

    def checked(match):
        path = match[1].split("#")[0]
        there = not path or "://" in path or (page.DOCS / "report" / html.unescape(path)).exists()
        return match[0] if there else match[2]

    return LINK.sub(checked, PICTURE.sub(moved, text))


def identified(text):
    """The section with an id for each of its parts (h3), "SECTION-1" and on."""
    name, number = re.search(r'<section id="([^"]+)">', text)[1], itertools.count(1)
    return re.sub(r"<h3(?: id=\S+)?>", lambda _: f'<h3 id="{name}-{next(number)}">', text)


def contents(sections):
    """The list of the sections and their parts, which stays beside the page."""
    lines = []
    for text in sections:
        identity, title = re.search(r'<section id="([^"]+)">', text), re.search(r"<h2>(.*?)</h2>", text)
        parts = re.findall(r'<h3 id="([^"]+)">(.*?)</h3>', text)
        inner = "".join(f'<li><a href="#{part}">{words}</a></li>' for part, words in parts)
        lines.append(f'<li><a href="#{identity[1]}">{title[1]}</a>{f"<ul>{inner}</ul>" if inner else ""}</li>')
    return "<nav>\n<ul>\n" + "\n".join(lines) + "\n</ul>\n</nav>\n"


def assemble(folder, studies, output):
    """Writes output/index.html; returns the bytes of everything in it."""
    staged = output.with_name(f".{output.name}.part")
    shutil.rmtree(staged, ignore_errors=True)
    staged.mkdir(parents=True)
    sections = [identified(take_section(*source(folder, name, output), name, staged)) for name in studies]
    opening = page.from_markdown((HERE / "opening.md").read_text())
    if "accuracy" not in studies:
        opening = re.sub(r"<figure>.*?</figure>\n", "", opening, flags=re.DOTALL)
    made = page.paragraph(f"Put together on {date.today().isoformat()} by ./dev report.")
    head = (
        '<meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>mortise: report</title><style>{page.STYLE}{STYLE}</style>"
    )
    body = f"{contents(sections)}<main>\n<h1>mortise</h1>\n{opening}{''.join(sections)}{made}</main>\n"
    (staged / "index.html").write_text(f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head>\n<body>\n{body}</body></html>\n')
    shutil.rmtree(output, ignore_errors=True)
    staged.rename(output)
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
