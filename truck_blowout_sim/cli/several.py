"""Options that take several values after one flag: ``--holdout a b``."""

from __future__ import annotations

from collections.abc import Collection, Sequence


def repeat_flags(words: Sequence[str], options: Collection[str]) -> list[str]:
    """Write a flag before each of the values that follow it.

    Args:
        words: of the command line, after the verb.
        options: flags that take several values, e.g. ``("--baseline", "--holdout")``.

    Returns:
        The same words with each further value of such a flag preceded by the flag. A value ends
        at the next option; ``--`` ends all options.
    """
    spread: list[str] = []
    flag, values = "", 0
    for at, word in enumerate(words):
        if word == "--":
            return [*spread, *words[at:]]
        if word.startswith("-") and len(word) > 1:
            flag, values = (word if word in options else ""), 0
        elif flag:
            values += 1
            if values > 1:
                spread.append(flag)
        spread.append(word)
    return spread
