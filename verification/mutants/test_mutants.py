"""The list of faults fits the sources."""

import collections

import pytest

import mutants

LIST = mutants.read_mutants()


@pytest.mark.parametrize("mutant", LIST, ids=lambda m: f"{m.file}: {m.what}")
def test_the_old_text_stands_once_and_the_new_one_differs(mutant):
    text = (mutants.ROOT / "src" / mutant.file).read_text()
    assert text.count(mutant.old) == 1
    assert mutant.new != mutant.old and "\n" not in mutant.new
    assert mutant.what


def test_the_list_covers_the_rooms():
    rooms = collections.Counter(map(mutants.room, LIST))
    assert len(LIST) >= 150 and len(set(LIST)) == len(LIST)
    assert min(rooms["contact"], rooms["results"], rooms["error"], rooms["fem"], rooms["solve"]) >= 25
