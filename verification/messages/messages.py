"""All that the program says of bad input and of doubtful results, with the tests that quote it.

A message is a statement of src that throws, refuses, warns or notes and has three words or more in a row. A test
quotes it if three words in a row, which no other message has (or all, if it has none of its own), stand in the test:
so it provokes the message and looks at it. Run: prints each message with its tests."""

import re
from collections import Counter, namedtuple
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
STRING = r'R"\(.*?\)"|"(?:[^"\\\n]|\\.)*"'
SAYS = re.compile(r"\b(?:InputError|SceneError|ExpressionError)\(|\b(?:fail\w*|refuse|conflict)\(|"
                  r"\bworded\(|\b(?:lines|notes)\.push_back|\b(?:text|where|advice)\s*<<|\badvice\b")  # fmt: skip

Message = namedtuple("Message", "place words")  # "file:line", its texts


def without_comments(text):
    pattern = re.compile(rf"{STRING}|'(?:[^'\\\n]|\\.)*'|//[^\n]*|/\*.*?\*/", re.S)
    return pattern.sub(lambda m: " " if m[0].startswith("/") else m[0], text)


def statements(text):
    """(line, statement): up to each ; { or } outside of texts."""
    last = 0
    for m in re.finditer(rf"{STRING}|'(?:[^'\\\n]|\\.)*'|[;{{}}]", text, re.S):
        if m[0] in (";", "{", "}"):
            start = last + len(text[last:]) - len(text[last:].lstrip())
            yield text.count("\n", 0, start) + 1, text[last : m.end()]
            last = m.end()


def texts_of(code):
    """Its texts; those that follow one another are one."""
    joined = re.sub(r'"\s*\n\s*f?"', "", code)
    found = (a or b for a, b in re.findall(r'R"\((.*?)\)"|"((?:[^"\\\n]|\\.)*)"', joined, re.S))
    return [text.replace('\\"', '"').replace("\\n", " ") for text in found]


def threes(text):
    """Each three words in a row, without what parts them."""
    words = re.findall(r"[\w$*<>=%.\[\]-]*\w[\w$*<>=%\]-]*", text)
    return {" ".join(words[i : i + 3]) for i in range(len(words) - 2)}


def messages():
    found = []
    for path in sorted(ROOT.glob("src/**/*.cpp")):
        for line, code in statements(without_comments(path.read_text())):
            words = [text for text in texts_of(code) if threes(text)]
            if words and SAYS.search(code) and "logic_error" not in code:
                found.append(Message(f"{path.relative_to(ROOT / 'src')}:{line}", words))
    return found


def tests():
    """By test file the threes of its texts."""
    patterns = ["tests/**/*.cpp", "tests/**/*_test.py", "verification/**/test_*.py", "verification/fuzz/*.py"]
    paths = [path for pattern in patterns for path in sorted(ROOT.glob(pattern))]
    read = {}
    for path in paths:
        code = without_comments(path.read_text()) if path.suffix == ".cpp" else path.read_text()
        quoted = texts_of(code) + re.findall(r"'([^'\n]*)'", code)
        read[str(path.relative_to(ROOT))] = set().union(*map(threes, quoted))
    return read


def quoted_by():
    """Each message with the test files that quote it."""
    all_messages, files = messages(), tests()
    count = Counter(three for m in all_messages for three in set().union(*map(threes, m.words)))
    for m in all_messages:
        said = set().union(*map(threes, m.words))
        own = {three for three in said if count[three] == 1} or said
        yield m, [name for name, quoted in files.items() if own & quoted]


def main():
    for m, by in quoted_by():
        print(f"{m.place}: {' ... '.join(m.words)}\n    {', '.join(by) or 'NO TEST'}")


if __name__ == "__main__":
    main()
