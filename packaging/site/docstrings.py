"""Reads the docstrings of the package for the site: examples become code, roles links, and what `#:` says of an attribute its docstring."""

import re
from typing import Any

import griffe

EXAMPLE = re.compile(r"^>>> .*?(?=\n\s*\n|\Z)", flags=re.MULTILINE | re.DOTALL)
ROLE = re.compile(r":(?:class|func|meth|attr|mod):`([^`]+)`")


def as_markdown(text: str, of: griffe.Object) -> str:
    """A docstring in Markdown."""

    def link(role: re.Match[str]) -> str:
        path = role[1]
        member = of.package.members.get(path.removeprefix("homebody."))
        if path.startswith("homebody.") and member is not None:
            path = member.target_path if member.is_alias else member.path
        elif not path.startswith("homebody."):
            # Of the same class, or of Python.
            owner = of if of.is_class else of.parent
            if owner is None or path not in owner.members:
                return f"`{path}`"
            path = owner.members[path].path
        return f"[`{role[1].removeprefix('homebody.')}`][{path}]"

    return EXAMPLE.sub(lambda example: f"```pycon\n{example[0]}\n```", ROLE.sub(link, text))


class Docstrings(griffe.Extension):
    """Changes docstrings once a package is read."""

    def on_package(self, *, pkg: griffe.Module, **kwargs: Any) -> None:
        self._read(pkg)

    def _read(self, of: griffe.Object) -> None:
        if of.is_attribute and of.docstring is None:
            said = _comment(of)
            if said:
                of.docstring = griffe.Docstring(said, parent=of)
        if of.docstring is not None:
            of.docstring.value = as_markdown(of.docstring.value, of)
        for member in of.members.values():
            # What is written in Rust is for the modules around it.
            if not member.is_alias and member.name != "_homebody":
                self._read(member)


def _comment(of: griffe.Object) -> str:
    """What the lines above an attribute say, if they begin with `#:`."""
    said: list[str] = []
    lines, above = of.lines_collection[of.filepath], (of.lineno or 0) - 2
    while above >= 0 and lines[above].strip().startswith("#:"):
        said.insert(0, lines[above].strip()[2:].strip())
        above -= 1
    return " ".join(said)
