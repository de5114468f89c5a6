"""Collects the pages of the site: `prepare.py ROOT PAGES`. packaging/site.sh calls it.

Documents keep their paths in the repository, so that links between them hold. A document that is named between backticks becomes a
link. A link to a file without a page, such as a licence, becomes plain text. The references list the modules and crates in the tree.
"""

import os
import re
import shutil
import sys
from pathlib import Path

#: Documents in the folder of the README, which becomes the first page.
BESIDE = ["ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md"]

#: The first modules of the Python reference; all others follow.
FIRST = ["scenario", "log", "table", "picture", "live", "driver", "cohort", "profiles", "env", "errors"]


def linked(text: str, name: str, pages: dict[str, str], root: Path) -> str:
    """The text of a document as a page: documents between backticks become links, and links to other files become text."""
    page = pages[name]
    here = Path(page).parent

    def link(span: re.Match[str]) -> str:
        target = pages.get(span[1])
        if target is None or target == page:
            return span[0]
        return f"[{span[0]}]({os.path.relpath(target, here)})"

    def relink(found: re.Match[str]) -> str:
        shown, path, anchor = found[1], found[2], found[3] or ""
        file = os.path.normpath(Path(name).parent / path)
        target = pages.get(file)
        if target is not None:
            return f"[{shown}]({os.path.relpath(target, here)}{anchor})"
        # mkdocs reports a link to a file that does not exist.
        return shown if (root / file).exists() else found[0]

    parts = re.split(r"(^```.*?^```$)", text, flags=re.MULTILINE | re.DOTALL)
    for number in range(0, len(parts), 2):
        # Every other part is fenced code. Pictures and links to the web stay.
        part = re.sub(r"(?<!!)\[([^\]]*)\]\((?!\w+:)([^)#\s]+)(#[^)\s]*)?\)", relink, parts[number])
        parts[number] = re.sub(r"(?<!\[)`([^`\n]+\.md)`", link, part)
    return "".join(parts)


def documents(root: Path, to: Path) -> None:
    """The README, the documents in its folder, and docs/ with its pictures."""
    pages = {name: name for name in BESIDE} | {"README.md": "index.md"}
    there = [path.relative_to(root).as_posix() for path in sorted((root / "docs").rglob("*.md"))]
    pages |= {name: name for name in there}
    notebooks = (root / "python/notebooks").glob("*.ipynb")
    known = pages | {path.relative_to(root).as_posix(): f"python/notebooks/{path.stem}.md" for path in notebooks}
    for name, page in pages.items():
        path = to / page
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(linked((root / name).read_text(encoding="utf-8"), name, known, root), encoding="utf-8")
    shutil.copytree(root / "docs/pictures", to / "docs/pictures")


def python_reference(root: Path, to: Path) -> None:
    """All modules for users, by their docstrings."""
    there = sorted(path.stem for path in (root / "python/homebody").glob("*.py") if not path.stem.startswith("_"))
    modules = [name for name in FIRST if name in there] + [name for name in there if name not in FIRST]
    # The function of the same name hides the module cohort, whose code is beside it.
    modules = ["_cohort" if name == "cohort" else name for name in modules]
    text = "# Reference of the Python package\n\nWhat `import homebody as hb` has is listed by the module in which it is written.\n"
    text += "".join(f"\n::: homebody.{name}\n" for name in modules)
    (to / "python").mkdir(exist_ok=True)
    (to / "python/reference.md").write_text(text, encoding="utf-8")


def rust_reference(root: Path, to: Path) -> None:
    """All crates, with a link to what `cargo doc` has made of them."""
    rows = []
    for library in sorted((root / "crates").glob("*/src/lib.rs")):
        name = library.parent.parent.name
        first = re.search(r"^//! (.+)", library.read_text(encoding="utf-8"), flags=re.MULTILINE)
        folder = name.replace("-", "_")
        is_there = (root / "target/doc" / folder / "index.html").is_file()
        shown = f'<a href="rust/{folder}/index.html"><code>{name}</code></a>' if is_there else f"`{name}`"
        rows.append(f"| {shown} | {first[1] if first else ''} |")
    text = "# Reference of the Rust crates\n\n"
    text += "`cargo doc --workspace --no-deps --features homebody/all` makes it. Where its pages were there as this site was built, "
    text += "they are in it, and the names are links.\n\n| crate | what it is |\n|---|---|\n" + "\n".join(rows) + "\n"
    (to / "rust.md").write_text(text, encoding="utf-8")


def main() -> None:
    root, to = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    shutil.rmtree(to, ignore_errors=True)
    to.mkdir(parents=True)
    documents(root, to)
    python_reference(root, to)
    rust_reference(root, to)


if __name__ == "__main__":
    main()
