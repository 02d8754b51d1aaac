#!/usr/bin/python3
"""The stability studies: where each method fails, how it shows, why, where it begins, and what mortise does about it.

A study is a module study_N_NAME.py with
  runs(quick)        its runs (stability_runs); or, if they are not of that kind, measure(store, quick): its rows
  complete(rows)     rows with figures that compare runs with one another (optional)
  draw(rows, path)   its picture, OUT/NAME.png, and others beside it
  failures(rows)     the failures found (failures.failure)
  values(rows)       what fills the first text of study_N_NAME.md (optional)
and a template study_N_NAME.md: title, introduction and captions; then a text for each failure, of three paragraphs:
where it begins, why, what mortise does. Written are OUT/NAME.csv, NAME.png, NAME.json and NAME.md, and of all of them
the table stability.md; the runs are kept in OUT/runs. --docs writes docs/stability.md and a page a study in
docs/stability/ from what the full studies have found. Exit status 1 also if a run ends as it must not: an internal
error, a crash, a hang, or a row that says 0 of `ok`.
"""

import importlib
import json
import os
import sys
import textwrap
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.with_name("common")))

import launch
import page
import runs
import stability_runs
import template

STUDIES = {path.stem.split("_")[2]: path.stem for path in HERE.glob("study_*.py")}
STUDIES = dict(sorted(STUDIES.items(), key=lambda item: int(item[1].split("_")[1])))
NEVER = ("internal error", "hang", "crash")


def write_table(path, rows):
    """Every scalar of every row; a key that a row lacks is an empty field."""
    keys = list(dict.fromkeys(key for row in rows for key, value in row.items() if not isinstance(value, (list, dict))))
    launch.write_csv(path, [{key: row.get(key) for key in keys} for row in rows])


def paragraphs(text):
    """Of a template's text, each in one line."""
    return [" ".join(part.split()) for part in text.split("\n\n")]


def said(failure, texts):
    """The failure with its words: where it begins, why, and what mortise does about it."""
    text, values = texts.pop(failure["name"]), failure.pop("values")
    if "{bound:" in text:
        values["bound"] = failure["bound"]
    begins, why, mortise = paragraphs(template.fill(text, **values))
    return {**failure, "begins": begins, "why": why, "mortise": mortise}


def carry_out(name, store, folder, quick):
    """Runs, table, pictures and failures of one study."""
    start, fresh, study = time.monotonic(), store.fresh, importlib.import_module(STUDIES[name])
    texts = template.texts(HERE / f"{STUDIES[name]}.md")
    print(f"{texts[''].splitlines()[0].removeprefix('# ')}", flush=True)
    measure = getattr(study, "measure", lambda *_: store.rows(study.runs(quick), stability_runs.execute, name))
    rows = measure(store, quick)
    rows = study.complete(rows) if hasattr(study, "complete") else rows
    write_table(folder / f"{name}.csv", rows)
    study.draw(rows, folder / f"{name}.png")
    head = template.fill(texts.pop(""), **(study.values(rows) if hasattr(study, "values") else {}))
    failures = [said(failure, texts) for failure in study.failures(rows)]
    if texts:
        raise template.TemplateError(f"{STUDIES[name]}.md: no failure is called {', '.join(texts)}")
    (folder / f"{name}.json").write_text(json.dumps(failures, indent=1) + "\n")
    for failure in failures:
        print(f"  [{failure['state']}] {failure['name']}: {failure['begins']}", flush=True)
    print(f"  {store.fresh - fresh} of {len(rows)} runs were new; {time.monotonic() - start:.0f} s", flush=True)
    wrong = [f"{name}: {row['outcome']}: {row}"[:600] for row in rows if row["outcome"].startswith(NEVER)]
    wrong += [f"{name}: not ok: {row}" for row in rows if row.get("ok") == 0]
    return {"name": name, "head": head, "rows": rows, "failures": failures, "wrong": wrong}


def outcomes(rows):
    """How many runs ended in which way, as words."""
    counts = {outcome: 0 for outcome in (row["outcome"] for row in rows)}
    for row in rows:
        counts[row["outcome"]] += 1
    return ", ".join(f"{count} {outcome}" for outcome, count in sorted(counts.items(), key=lambda item: -item[1]))


def wrapped(text, indent=""):
    return textwrap.fill(text, 120, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)


def title(result):
    return f"{list(STUDIES).index(result['name']) + 1}. {result['head'].removeprefix('# ').splitlines()[0]}"


def study_page(result):
    """OUT/NAME.md: what was varied, the pictures, and each failure with its cause."""
    failures, heads = result["failures"], result["head"].split("\n\n")[1:]
    parts = [f"# {title(result)}", "What the states mean: [where it fails](../stability.md)."]
    parts += [part if part[0] in "|#" else wrapped(" ".join(part.split())) for part in heads]
    parts.append(template.table(["what fails", "begins at", "state"], [[f["name"], f["begins"], f["state"]] for f in failures]))
    parts += [wrapped(f"- **{f['name']}.** {f['why']} *mortise:* {f['mortise']}", "  ") for f in failures]
    return "\n\n".join([*parts, f"{len(result['rows'])} runs: {outcomes(result['rows'])}."])


def page_text(results, quick):
    """The one table of all failures, each with a link to its study."""
    link = lambda result: f"[{title(result)}](stability/{result['name']}.md)"
    rows = [[link(r), f["name"], f["begins"], f["state"]] for r in results for f in r["failures"]]
    table = template.table(["study", "what fails", "begins at", "state"], rows)
    return template.fill((HERE / "stability.md").read_text(), quick=quick, table=table)


def write_pages(folder, results, options):
    for result in results:
        text = study_page(result)
        (folder / f"{result['name']}.md").write_text(text + "\n")
        if options.docs:
            page.write_docs(folder, "stability", text, f"stability/{result['name']}")
    page.write(folder, "stability", page_text(results, options.quick), options.docs)


def run_studies(folder, quick, names=(), jobs=1):
    """The results of all studies, or of those named."""
    os.environ.update(launch.ONE_THREAD)
    folder.mkdir(parents=True, exist_ok=True)
    store = runs.Store(folder / "runs", [stability_runs.__file__], jobs=jobs)
    return [carry_out(name, store, folder, quick) for name in names or STUDIES]


def main(arguments=None):
    options = launch.command_line(__doc__, "stability", arguments, names=list(STUDIES), docs=True)
    try:
        results = run_studies(options.output, options.quick, options.only, options.jobs)
    except launch.StudyError as error:
        sys.exit(f"stability.py: {error}")
    write_pages(options.output, results, options)
    wrong = [line for result in results for line in result["wrong"]]
    print(*wrong, f"{options.output}/stability.md", sep="\n")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
