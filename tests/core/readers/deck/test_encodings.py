"""A deck is read in the encoding that it was written in, whatever letters its title has."""

import pytest

from tests.chance import count, seeded
from tests.commands import CASES
from vstatics.core.readers.deck import reader
from vstatics.core.readers.deck.encodings import ENCODINGS, in_each_encoding

TEXT = (
    "исходные данные для коробки передач звенья фрикцион тормоз муфта планетарный ряд водило "
    "солнечная шестерня коронное колесо сателлит эпицикл передаточное число момент скорость "
    "вращения обороты двигатель редуктор трактор тягач самосвал гидротрансформатор нейтраль "
    "задний ход включение диск пружина вал ведущий ведомый сцепление потери мощность схема "
    "расчёт вариант таблица кинематика силовой поток блокировка корпус ступень механизм"
)
WORDS = TEXT.split()


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("case", ["lower", "upper", "title", "mixed"])
def test_words_are_read_as_they_were_written(encoding: str, case: str) -> None:
    chance = seeded(3)
    for _ in range(count(100, 1000)):
        shapes = [str.lower, str.upper, str.capitalize]
        chosen = [chance.choice(shapes) if case == "mixed" else getattr(str, case)] * 4
        drawn = chance.sample(WORDS, 4)
        text = " ".join(shape(word) for shape, word in zip(chosen, drawn, strict=True))
        text = f"KJG= 6\n{text} {chance.randint(1, 9999)}\nNAME F1: {chance.choice('ТФМ')}1\n"
        assert in_each_encoding(text.encode(encoding))[0] == text


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize(
    "name", ["МЗКТ 7922", "БелАЗ-7516", "БЕЛАЗ", "КамАЗ", "УРАЛ", "Нейтраль", "Ф2", "коробка"]
)
def test_the_title_of_a_deck_tells_its_encoding(encoding: str, name: str) -> None:
    text = (CASES / "mzkt7922.dat").read_text("utf-8") + f"NAME T: {name}\n"
    assert reader.read(text.encode(encoding), "old.dat").case.name == name


def test_lines_of_a_table_are_no_words() -> None:
    text = "┌───────┬──────┐\n│ Звено │ i    │\n"
    text += "╞═══════╪══════╡\n│ ВАЛ 1 │ 2.5  │\n└──┴══┘ ██░░ ─ │ ══ ╔╗\n"
    for encoding in ("cp866", "koi8-r"):
        assert in_each_encoding(text.encode(encoding))[0] == text
