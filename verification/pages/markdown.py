"""What a user would type, as README.md and docs/*.md print it: files, commands, figures.

A fence after a paragraph that begins with a file's name in backquotes is that file; a fence of the language sh holds
commands. In the text, `KEY = NUMBER` is an entry of the summary.json of the last scene before it, `NUMBER` alone a
figure that a command of the section prints.
"""

import re

import launch

FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NAME = re.compile(r"(?:^|and |; )`(\w+\.(?:geo|toml|py))`[^`]*$")
NUMBER = r"-?\d+\.?\d*(?:e-?\d+)?"
AS_PRINTED = 5e-3  # relative; the recipes ask for 1 %


def sections(text):
    """{heading: text} of the sections of level 2."""
    pieces = re.split(r"^## (.*)$", text, flags=re.MULTILINE)
    return dict(zip(pieces[1::2], pieces[2::2]))


def files(text):
    """{name: contents} of the fences that are files."""
    found = {}
    for fence in FENCE.finditer(text):
        before = text[: fence.start()].rstrip().rsplit("\n\n", 1)[-1]
        if named := NAME.search(before):
            found[named[1]] = fence[2]
    return found


def commands(text):
    """The lines of the fences of commands, without what follows #."""
    lines = [line for fence in FENCE.finditer(text) if fence[1] == "sh" for line in fence[2].splitlines()]
    return [line.split(" #")[0].strip() for line in lines if line.strip()]


def entry(summary, key):
    """Of "contact.0.force.1"."""
    for part in key.split("."):
        summary = summary[int(part) if isinstance(summary, list) else part]
    return summary


def near(found, printed):
    return abs(found - printed) <= AS_PRINTED * abs(printed)


def wrong_figures(text, folder, said):
    """The figures of a section that are not those of its results in `folder`, or not among the words `said`."""
    prose, wrong = FENCE.sub("", text), []
    scenes = re.findall(r"mortise solve (\w+)\.toml", "\n".join(commands(text)))
    for key, value in re.findall(rf"`([\w.]+) = ({NUMBER})`", prose):
        found = entry(launch.summary(folder / "out" / scenes[-1]), key)
        if not near(found, float(value)):
            wrong.append(f"{key}: {value} printed, {found} found")
    numbers = [float(word) for word in re.findall(NUMBER, said)]
    for value in re.findall(rf"`({NUMBER})`", prose):
        if not any(near(found, float(value)) for found in numbers):
            wrong.append(f"{value} printed, not among what the commands say")
    return wrong
