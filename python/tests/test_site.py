"""What the site of the documentation leads to."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]


def led_to(text: str) -> set[str]:
    """The pages of the navigation."""
    return set(re.findall(r": (\S+\.md)$", text.split("\nnav:\n")[1], flags=re.MULTILINE))


def wanted() -> set[str]:
    """A page for each document and notebook."""
    documents = {path.relative_to(ROOT).as_posix() for path in (ROOT / "docs").rglob("*.md")}
    notebooks = {f"python/notebooks/{path.stem}.md" for path in (ROOT / "python/notebooks").glob("*.ipynb")}
    beside = {"index.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md", "python/reference.md", "rust.md"}
    return documents | notebooks | beside


def test_the_navigation_leads_to_every_document_and_to_nothing_else() -> None:
    text = (ROOT / "packaging/site/mkdocs.yml").read_text()
    assert led_to(text) == wanted()
    assert led_to(text.replace("docs/reference/home.md", "docs/hoem.md")) != wanted()
