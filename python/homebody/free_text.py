"""Routines from free text: a care plan, a diary or the description of a person.

>>> import homebody as hb
>>> answer = '''{"lines": [{"source": "Walter naps after lunch.", "statements": ["He naps after lunch for 40 minutes."],
... "assumed": ["the length"], "cannot_be_said": []}]}'''
>>> life = hb.life_from("Walter naps after lunch.", "studio", answer=answer)
>>> life.rows[0].statements[0].sentences
['He naps after he eats lunch for 40 minutes.']
>>> life.rows[0].assumed
['the length']
>>> home = hb.scenario("studio").with_routine("walter", life.routine())
"""

from __future__ import annotations

import json
import warnings
from collections.abc import Sequence
from dataclasses import dataclass, field
from os import PathLike
from typing import Any

from homebody import _homebody, arguments
from homebody.progress import Progress
from homebody.scenario import Scenario, opened


@dataclass(frozen=True)
class DraftStatement:
    """A sentence of the model, and how Homebody reads it."""

    #: As the model writes it.
    text: str
    #: The reason why it is refused; then it comes into no routine.
    refused: str | None = None
    #: Its meaning as data, as in :func:`homebody.life`; empty if it is refused.
    statements: list[dict[str, Any]] = field(default_factory=list)
    #: Its meaning as canonical sentences.
    sentences: list[str] = field(default_factory=list)
    #: The difference to its simulation, such as ``expected 60 naps; simulated 41``.
    difference: str | None = None


@dataclass(frozen=True)
class DraftRow:
    """A source in the text, and the statements that are made of it."""

    #: As the model quotes it.
    source: str
    #: Whether the text has such a sentence. If not, the statements may be invented.
    is_in_text: bool
    statements: list[DraftStatement]
    #: Choices of the model where the text leaves something open.
    assumed: list[str]
    #: The parts that a routine cannot say.
    cannot_be_said: list[str]
    #: The list of the answer that has the statement of this row, where nothing is simulated; ``None`` for a row of statements.
    stands_under: str | None = None

    @property
    def problems(self) -> list[str]:
        """Refused statements with their reasons, and differences to the simulation."""
        refused = [f"{one.text!r} is refused: {one.refused}" for one in self.statements if one.refused is not None]
        differences = [f"{one.text!r}: {one.difference}" for one in self.statements if one.difference is not None]
        invented = [] if self.is_in_text or not self.statements else [f"the text has no such sentence: {self.source!r}"]
        misplaced = [f"the answer has {one.text!r} under {self.stands_under!r}" for one in self.statements if self.stands_under is not None]
        return invented + refused + misplaced + differences

    @property
    def is_usable(self) -> bool:
        """Whether a routine can have one of its statements."""
        return any(one.refused is None for one in self.statements)


@dataclass(frozen=True)
class ConversationRound:
    """A prompt, its answer, and the findings in it."""

    prompt: str
    answer: str
    problems: list[str]
    #: Differences between statements and their simulation.
    differences: list[str]


class FreeTextLife:
    """The statements that a model or an assistant made of a text, next to their sources. :func:`life_from` makes one."""

    def __init__(self, conversation: _homebody.Conversation, model: str | None) -> None:
        self._conversation = conversation
        draft, self._table, self._warnings = conversation.draft()
        known = json.loads(draft)
        #: The model and its address; ``None`` for given answers.
        self.model = model
        #: The rows of the best round, in the order of the answer.
        self.rows: list[DraftRow] = [_row(line) for line in known["lines"]]
        #: Sentences of the text that the answer leaves out.
        self.left_out: list[str] = known["left_out"]
        #: The reason why a run with all statements stops.
        self.run_stops: str | None = known.get("run_stops")

    @property
    def rounds(self) -> list[ConversationRound]:
        """The prompts and answers, in order."""
        return [ConversationRound(**one) for one in json.loads(self._conversation.rounds)]

    @property
    def cannot_be_said(self) -> list[str]:
        """The parts of the text that a routine cannot say."""
        return [part for row in self.rows for part in row.cannot_be_said]

    @property
    def problems(self) -> list[str]:
        """Refused sentences, left out sentences and differences to the simulation, as the command reports them."""
        return list(self._warnings)

    @property
    def prompt(self) -> str | None:
        """The next prompt for the same assistant; ``None`` if nothing more is to be asked."""
        return None if self._conversation.is_over else self._conversation.prompt

    def routine(self, accept: Sequence[bool] | None = None) -> str:
        """The text of a routine from the accepted rows, with their sources as comments. Without ``accept``, all usable rows are accepted,
        but for sentences among the notes of the answer.

        Nothing is written: :meth:`homebody.Scenario.with_routine` takes the text.
        """
        accepted = [row.is_usable and row.stands_under is None for row in self.rows] if accept is None else _flags(accept, len(self.rows))
        text, lost = self._conversation.routine(accepted)
        for why in lost:
            warnings.warn(f"not in the routine: {why}", stacklevel=2)
        return text

    def __str__(self) -> str:
        return self._table

    def __repr__(self) -> str:
        usable = sum(row.is_usable for row in self.rows)
        return f"<homebody.FreeTextLife of {self._conversation.person}: {usable} of {len(self.rows)} rows can be accepted>"


def life_from(
    text: str,
    home: Scenario | str | PathLike[str],
    *,
    resident: str | None = None,
    model: str | None = None,
    model_name: str | None = None,
    key: str | None = None,
    timeout_s: float | None = None,
    answer: str | Sequence[str] | None = None,
    progress: bool | None = None,
) -> FreeTextLife:
    """Makes statements about a resident from a text. A language model writes them; Homebody checks each one and simulates 60 days.

    What is refused and what does not happen as it says goes back to the model, in at most four rounds. ``model`` is the address of any
    server with the chat interface of OpenAI; without it, Ollama or llama.cpp on this machine is asked, and nothing is sent to any other
    address. ``model_name`` chooses one of its models. The ``key`` comes from the environment variable ``HOMEBODY_MODEL_KEY`` unless it
    is given; it goes to ``model`` only. ``timeout_s`` is the longest wait for each answer.

    With ``answer``, no model is asked: it is the answer of any assistant to the prompt of :func:`life_prompt`, or all of its answers in
    order.
    """
    conversation = _conversation(text, home, resident)
    if answer is not None:
        for other, given in (("model", model), ("model_name", model_name), ("key", key)):
            if given is not None:
                raise ValueError(f"{other} is given together with answer; expected only one of them")
        _take(conversation, answer)
        return FreeTextLife(conversation, None)
    url, name, secret = _text("model", model), _text("model_name", model_name), _text("key", key)
    with Progress("asking the model", progress) as tell:
        asked, warning = conversation.converse(url, name, secret, _seconds(timeout_s), tell)
    if warning is not None:
        warnings.warn(warning, stacklevel=2)
    return FreeTextLife(conversation, asked)


def life_prompt(
    text: str,
    home: Scenario | str | PathLike[str],
    *,
    resident: str | None = None,
    answer: str | Sequence[str] = (),
) -> str:
    """The prompt for any assistant, to be pasted there; with answers so far, the next one for the same chat.

    >>> import homebody as hb
    >>> "1. Walter naps after lunch." in hb.life_prompt("Walter naps after lunch.", "studio")
    True
    """
    conversation = _conversation(text, home, resident)
    _take(conversation, answer)
    return conversation.prompt


def _conversation(text: str, home: Scenario | str | PathLike[str], resident: str | None) -> _homebody.Conversation:
    name = _text("resident", resident)
    said = arguments.text("text", text, "a text: a care plan, a diary or the description of a person")
    return _homebody.Conversation(opened("home", home)._scenario, name, said)


def _take(conversation: _homebody.Conversation, answer: str | Sequence[str]) -> None:
    for one in [answer] if isinstance(answer, str) else arguments.texts("answer", answer, "an answer, or a list of answers"):
        conversation.take(one)


def _text(name: str, value: str | None) -> str | None:
    return None if value is None else arguments.text(name, value)


def _seconds(timeout_s: float | None) -> float | None:
    if timeout_s is None:
        return None
    seconds = arguments.number("timeout_s", timeout_s)
    if not 0 < seconds <= 86_400:
        raise ValueError(f"timeout_s is {seconds}; expected more than 0 and at most 86,400 (a day)")
    return seconds


def _flags(accept: Sequence[bool], count: int) -> list[bool]:
    flags = [arguments.flag(f"accept[{index}]", one) for index, one in enumerate(accept)]
    if len(flags) != count:
        raise ValueError(f"accept has {len(flags)} entries; expected one for each of the {count} rows")
    return flags


def _row(line: dict[str, Any]) -> DraftRow:
    statements = [_statement(one) for one in line["statements"]]
    return DraftRow(line["source"], line["is_in_text"], statements, line["assumed"], line["cannot_be_said"], line.get("stands_under"))


def _statement(one: dict[str, Any]) -> DraftStatement:
    meaning, difference = one.get("meaning", []), one.get("difference")
    said = None if difference is None else f"expected {difference['expected']}; simulated {difference['lived']}"
    statements, sentences = [row["statement"] for row in meaning], [row["in_words"] for row in meaning]
    return DraftStatement(one["text"], one.get("refused"), statements, sentences, said)
