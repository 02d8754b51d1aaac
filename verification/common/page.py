"""Pages of the studies: docs/NAME.md, and the sections of the report, HTML in one style.

A study writes its results into a folder of its own, out/NAME, and beside them section.html: a fragment whose pictures
are files below that folder. A fragment is a page by itself as it stands (every browser opens it); the report puts
several together.
"""

import html
import re

import figure
import launch

DOCS = launch.ROOT / "docs"

STYLE = """
:root { color-scheme: light dark; --page: #ffffff; --ink: #1c1c1c; --line: #d8d8d8; --head: #f2f2f2; --link: #1a56b0;
  --good: #17702a; --bad: #b80000 }
@media (prefers-color-scheme: dark) {
  :root { --page: #16181b; --ink: #dcdcdc; --line: #3a3e44; --head: #23272c; --link: #8ab4f8; --good: #6fcf84; --bad: #ff8a80 }
  img { filter: brightness(0.9) }
}
body { font: 15px/1.45 system-ui, sans-serif; color: var(--ink); background: var(--page); max-width: 1180px; margin: 2em auto;
  padding: 0 1em; overflow-wrap: anywhere }
a { color: var(--link) }
h1 { font-size: 1.6em } h2 { font-size: 1.3em; margin-top: 2.2em; border-bottom: 1px solid var(--line) }
h3 { font-size: 1.05em }
table { border-collapse: collapse; font-size: 13px; margin: 1em 0; max-width: 100% }
th, td { padding: 2px 6px; text-align: left; border-bottom: 1px solid var(--line); overflow-wrap: break-word }
th { background: var(--head); vertical-align: bottom; hyphens: auto }
td.number { text-align: right; font-variant-numeric: tabular-nums }
td.ok { color: var(--good) } td.failed, td.error, .bad { color: var(--bad); font-weight: 600 }
img { max-width: 100%; background: white; border: 1px solid var(--line) } p, ul { max-width: 80ch }
figure { margin: 1.2em 0 } figcaption { font-size: 13.5px; max-width: 90ch }
@media (max-width: 1100px) { table { font-size: 12px } th, td { padding: 2px 4px } }
table:has(th:nth-child(11)) { font-size: 11px } table:has(th:nth-child(11)) :is(th, td) { padding: 2px 3px }
table:has(th:nth-child(11)) th { overflow-wrap: anywhere; min-width: 4.6em }
@media (max-width: 800px) { table { display: block; overflow-x: auto } }
"""


def cell(value, show=html.escape):
    """A table's cell; numbers stand right, the words ok, failed and error in their colours."""
    text = str(value)
    kind = text if text in ("ok", "failed", "error") else "number" if text[:1].isdigit() or text[:1] in "-–" else ""
    return f'<td class="{kind}">{show(text)}</td>'


def table(heading, rows, show=html.escape):
    head = "".join(f"<th>{html.escape(text)}</th>" for text in heading)
    body = "\n".join("<tr>" + "".join(cell(value, show) for value in row) + "</tr>" for row in rows)
    return f"<table>\n<tr>{head}</tr>\n{body}\n</table>\n"


def paragraph(text):
    return f"<p>{html.escape(text)}</p>\n"


def picture(path, caption):
    """A picture by its path below the study's folder."""
    text = html.escape(caption)
    return f'<figure><img src="{html.escape(str(path))}" alt="{text}"><figcaption>{text}</figcaption></figure>\n'


INLINE = [
    (r"`([^`]+)`", r"<code>\1</code>"),
    (r"\*\*(.+?)\*\*", r"<b>\1</b>"),
    (r"(?<![\w*])\*([^*\s][^*]*)\*(?![\w*])", r"<i>\1</i>"),
    (r"\[([^\]]+)\]\(([^)]+)\)", r'<a href="\2">\1</a>'),
]


def inline(text):
    text = html.escape(text, quote=False)
    for pattern, replacement in INLINE:
        text = re.sub(pattern, replacement, text)
    return text


def block_html(block):
    """One block of Markdown, between empty lines."""
    lines = block.splitlines()
    if found := re.fullmatch(r"(#+) (.*)", block):
        level = min(len(found[1]) + 1, 4)
        return f"<h{level}>{inline(found[2])}</h{level}>\n"
    if found := re.fullmatch(r"!\[(.*)\]\((.*)\)", block, re.DOTALL):
        return picture(found[2], found[1].replace("\n", " "))
    if lines[0].startswith("|"):
        rows = [[part.strip().replace("\\|", "|") for part in re.split(r"(?<!\\)\|", line)[1:-1]] for line in lines]
        return table(rows[0], rows[2:], inline)
    if lines[0].startswith("- "):
        items = re.split(r"^- ", block, flags=re.MULTILINE)[1:]
        return "<ul>\n" + "".join(f"<li>{inline(item)}</li>\n" for item in items) + "</ul>\n"
    return f"<p>{inline(block)}</p>\n"


def from_markdown(text):
    """HTML of the Markdown that the studies write: headings (# is h2), paragraphs, lists of one level, tables, pictures
    with their captions in the brackets, and within a line code, bold, italics and links."""
    return "".join(block_html(block) for block in re.split(r"\n\s*\n", text.strip()))


def write_section(folder, name, title, parts):
    """FOLDER/section.html: `parts` (HTML texts) under a title that links to #NAME."""
    body = f'<section id="{name}">\n<h2>{html.escape(title)}</h2>\n' + "".join(parts) + "</section>\n"
    (folder / "section.html").write_text(f'<meta charset="utf-8"><style>{STYLE}</style>\n' + body)


def write(folder, name, text, docs=False):
    """FOLDER/section.html of a page in Markdown, and write_docs() if `docs`. The page's pictures are NAME/FILE.png in it
    and FOLDER/FILE.png here; links to other pages of docs/ are made for docs/report/."""
    title, body = text.removeprefix("# ").split("\n", 1)
    for_report = re.sub(r"\]\(([\w/]+\.md)\)", r"](../\1)", body.replace(f"]({name}/", "]("))
    write_section(folder, name, title, [from_markdown(for_report)])
    if docs:
        write_docs(folder, name, text)


def write_docs(folder, name, text):
    """docs/NAME.md, its pictures (with few colours) in docs/NAME/."""
    (DOCS / f"{name}.md").write_text(text)
    for path in re.findall(rf"\]\({name}/(.+?\.png)\)", text):
        figure.copy_small(folder / path, DOCS / name / path)
