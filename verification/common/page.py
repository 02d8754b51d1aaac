"""Pages of the studies, in Markdown: OUT/NAME.md beside its pictures, and docs/NAME.md."""

import re

import launch  # makes src/python/pictures known
import figure

DOCS = launch.ROOT / "docs"


def write(folder, name, text, docs=False):
    """FOLDER/NAME.md and, if `docs`, docs/NAME.md. The text's pictures are NAME/FILE.png in docs/, FOLDER/FILE.png here."""
    local = re.sub(rf"\]\((?!{name}/)([\w/]+\.md)\)", rf"]({DOCS}/\1)", text).replace(f"]({name}/", "](")
    (folder / f"{name}.md").write_text(local.rstrip() + "\n")
    if docs:
        write_docs(folder, name, text)


def write_docs(folder, name, text, page=None):
    """docs/PAGE.md (default: docs/NAME.md) and its pictures, with few colours, in docs/NAME/."""
    path = DOCS / f"{page or name}.md"
    path.write_text(text.rstrip() + "\n")
    for picture in re.findall(r"\]\((\S+?\.png)\)", text):
        target = path.parent / picture
        figure.copy_small(folder / target.relative_to(DOCS / name), target)
