"""Lives from free text, with a server that plays the part of a model."""

from __future__ import annotations

import json
import re
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import homebody as hb
import pytest

TEXT = "Walter gets up at seven. After lunch he has a nap. He misses his wife."
RIGHT = "He gets up at 07:00."
WRONG = "He gets up sevenish."
KEY = "sk-secret-of-a-test"


def answer(first: str) -> str:
    def line(source: str, statements: list[str], cannot: list[str]) -> dict[str, Any]:
        return {"source": source, "statements": statements, "assumed": [], "cannot_be_said": cannot}

    lines = [
        line("Walter gets up at seven.", [first], []),
        line("After lunch he has a nap.", ["He naps after lunch for 40 minutes."], []),
        line("He misses his wife.", [], ["a feeling"]),
    ]
    return f"Here you are:\n```json\n{json.dumps({'lines': lines})}\n```"


class Played:
    """The requests that a played server has got."""

    def __init__(self) -> None:
        self.url = ""
        self.requests: list[dict[str, Any]] = []
        self.keys: list[str | None] = []


@contextmanager
def played(*replies: str | int) -> Iterator[Played]:
    """A server that gives these contents or statuses in order, and then the last one again."""
    seen, left = Played(), list(replies)

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self.give(200, {"data": [{"id": "small"}]})

        def do_POST(self) -> None:
            body = self.rfile.read(int(self.headers["content-length"]))
            seen.requests.append(json.loads(body))
            seen.keys.append(self.headers.get("authorization"))
            reply = left.pop(0) if len(left) > 1 else left[0]
            if isinstance(reply, int):
                self.give(reply, {"error": {"message": f"no: {self.headers.get('authorization')}"}})
            else:
                self.give(200, {"choices": [{"message": {"role": "assistant", "content": reply}}]})

        def give(self, status: int, body: dict[str, Any]) -> None:
            text = json.dumps(body).encode()
            self.send_response(status)
            self.send_header("content-length", str(len(text)))
            self.end_headers()
            self.wfile.write(text)

        def log_message(self, *args: object) -> None:
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    seen.url = f"http://127.0.0.1:{server.server_address[1]}/v1"
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield seen
    finally:
        server.shutdown()
        server.server_close()


@pytest.fixture(scope="module")
def home() -> hb.Scenario:
    return hb.scenario("studio")


def test_a_model_is_asked_until_nothing_is_wrong(home: hb.Scenario) -> None:
    with played(answer(WRONG), answer(RIGHT)) as server:
        life = hb.life_from(TEXT, home, model=server.url)
    assert (len(life.rounds), len(server.requests), life.model) == (2, 2, f"small at {server.url}")
    assert life.rounds[0].problems and not life.rounds[1].problems
    assert "sevenish" in life.rounds[0].answer and "is refused" in server.requests[1]["messages"][-1]["content"]
    getting_up, nap, feeling = life.rows
    assert (getting_up.source, getting_up.statements[0].text) == ("Walter gets up at seven.", RIGHT)
    statement = nap.statements[0].statements[0]
    assert (statement["kind"], statement["activity"]) == ("habit", "napping")
    assert life.cannot_be_said == feeling.cannot_be_said == ["a feeling"]
    assert (life.problems, life.left_out, life.prompt) == ([], [], None)
    # A statement makes the sentence that was shown beside it.
    assert hb.life(statement).replace("She", "He").replace("she", "he") == nap.statements[0].sentences[0] + "\n"
    assert "Walter gets up at seven." in str(life) and "2 of 3 rows" in repr(life)
    # The routine is one that the reader of routines understands, with the sources as comments.
    routine = life.routine()
    assert f"# Walter gets up at seven.\n{RIGHT}\n" in routine and "cannot be said: a feeling" in routine
    assert home.with_routine("walter", routine).routine("walter") == routine
    assert f"not accepted: {RIGHT}" in life.routine([False, True, True])


def test_an_assistant_answers_by_hand(home: hb.Scenario) -> None:
    first = hb.life_prompt(TEXT, home)
    assert "1. Walter gets up at seven." in first and "cannot_be_said" in first
    life = hb.life_from(TEXT, home, answer=answer(WRONG))
    assert life.rows[0].problems[0].startswith(f"{WRONG!r} is refused: ")
    assert not life.rows[0].is_usable and any("sevenish" in problem for problem in life.problems)
    assert life.prompt == hb.life_prompt(TEXT, home, answer=answer(WRONG))
    assert life.prompt is not None and "sevenish" in life.prompt
    assert "sevenish" not in re.sub("(?m)^#.*", "", life.routine())
    done = hb.life_from(TEXT, "studio", answer=[answer(WRONG), answer(RIGHT)])
    assert (done.prompt, len(done.rounds), done.model) == (None, 2, None)


def test_a_sentence_that_does_not_happen_is_told(home: hb.Scenario) -> None:
    lines = [
        {"source": "Walter is out.", "statements": ["He gets up at 07:00.", "He is out from 09:00 to 17:00."]},
        {"source": "A nurse comes.", "statements": ["A nurse visits every day at 12:00 for 20 minutes."]},
    ]
    life = hb.life_from("Walter is out. A nurse comes.", home, answer=json.dumps({"lines": lines}))
    difference = life.rows[1].statements[0].difference
    assert difference is not None and difference.startswith("expected ") and "; simulated " in difference
    assert difference in life.rows[1].problems[0] and life.prompt is not None and "A nurse" in life.prompt


def test_sentences_without_a_source_and_without_a_row_are_told(home: hb.Scenario) -> None:
    lines = [{"source": "He sings.", "statements": ["He reads at 20:00 for 20 minutes."]}]
    life = hb.life_from("She rings.", home, answer=json.dumps({"lines": lines}))
    assert life.rows[0].problems == ["the text has no such sentence: 'He sings.'"]
    assert (life.rows[0].is_in_text, life.left_out) == (False, ["She rings."])


def test_a_key_goes_to_the_named_server_and_is_never_told(home: hb.Scenario, monkeypatch: pytest.MonkeyPatch) -> None:
    with played(answer(RIGHT)) as server:
        hb.life_from(TEXT, home, model=server.url, key=KEY)
        monkeypatch.setenv("HOMEBODY_MODEL_KEY", "sk-of-the-environment")
        hb.life_from(TEXT, home, model=server.url)
    assert server.keys == [f"Bearer {KEY}", "Bearer sk-of-the-environment"]
    with played(401) as server, pytest.raises(hb.ModelError) as refused:
        hb.life_from(TEXT, home, model=server.url, key=KEY)
    assert refused.value.code == "model::key" and refused.value.hint is not None
    assert KEY not in f"{refused.value} {refused.value.data}"


def test_a_model_that_fails_is_told(home: hb.Scenario) -> None:
    for reply, code in ((500, "model::status"), (404, "model::not-found"), ("I cannot help.", "free-text::nothing-usable")):
        with played(reply) as server, pytest.raises(hb.ModelError) as failed:
            hb.life_from(TEXT, home, model=server.url)
        assert (failed.value.code, failed.value.hint is not None) == (code, True)
    with pytest.raises(hb.ModelError, match="does not answer"):
        hb.life_from(TEXT, home, model="http://127.0.0.1:9/v1", model_name="small")
    with pytest.raises(hb.ModelError, match="is no address of a model's server"):
        hb.life_from(TEXT, home, model="here")


def test_wrong_texts_and_residents_are_refused(home: hb.Scenario) -> None:
    with pytest.raises(hb.HomebodyError, match="at most 20000") as long:
        hb.life_prompt("She naps after lunch. " * 10_000, home)
    assert long.value.code == "free-text::too-long"
    with pytest.raises(hb.HomebodyError, match="no sentence"):
        hb.life_prompt("...", home)
    with pytest.raises(hb.ScenarioError, match="walter"):
        hb.life_prompt(TEXT, home, resident="ada")


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"text": 5}, "text is 5; expected a text: a care plan"),
        ({"home": 5}, "home is 5; expected a scenario"),
        ({"resident": 5}, "resident is 5; expected a text"),
        ({"model": 5}, "model is 5; expected a text"),
        ({"timeout_s": 0}, "timeout_s is 0.0; expected more than 0"),
        ({"answer": 5}, "answer is 5; expected an answer, or a list of answers"),
        ({"answer": "x", "model": "http://127.0.0.1:9/v1"}, "model is given together with answer"),
        ({"progress": "yes"}, "progress is 'yes'; expected True or False"),
    ],
)
def test_wrong_arguments_are_named(options: dict[str, Any], told: str) -> None:
    with pytest.raises((TypeError, ValueError), match=told):
        hb.life_from(**({"text": TEXT, "home": "studio"} | options))


def test_rows_are_accepted_one_by_one(home: hb.Scenario) -> None:
    life = hb.life_from(TEXT, home, answer=answer(RIGHT))
    with pytest.raises(ValueError, match="accept has 1 entries; expected one for each of the 3 rows"):
        life.routine([True])
    with pytest.raises(TypeError, match=r"accept\[0\] is 'yes'"):
        life.routine(["yes", True, True])  # type: ignore[list-item]
