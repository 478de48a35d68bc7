"""LaTeX, where it is installed."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path


def typeset(text: str, folder: Path) -> str:
    """What LaTeX has to say; nothing where it is not installed."""
    if shutil.which("pdflatex") is None:
        return ""
    (folder / "typeset.tex").write_text(text, encoding="utf-8")
    done = subprocess.run(
        ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "typeset.tex"],
        cwd=folder,
        capture_output=True,
        text=True,
        errors="replace",
        check=False,
    )
    assert done.returncode == 0, done.stdout[-2000:]
    assert (folder / "typeset.pdf").exists()
    return done.stdout
