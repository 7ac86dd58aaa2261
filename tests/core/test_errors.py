"""What a refusal repeats of a file of megabytes stays readable."""

from __future__ import annotations

from core.errors import MOST_LETTERS, InputError


def test_a_sentence_of_a_million_letters_keeps_its_ends() -> None:
    refusal = InputError(f"The name “{'x' * 1_000_000}” is too long. Shorten it.", "x" * 1_000_000)
    assert len(str(refusal)) < MOST_LETTERS + 10
    assert refusal.sentence.startswith("The name “xxx")
    assert refusal.sentence.endswith("xxx” is too long. Shorten it.")
    assert len(refusal.where or "") < MOST_LETTERS + 10
