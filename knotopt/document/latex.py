"""A document as LaTeX: an article with packages that every distribution has, or its tables."""

from __future__ import annotations

import re
from collections.abc import Sequence

from knotopt.document.model import Block, Document, Picture, Table, marked

_HEAD = r"""\documentclass[a4paper,10pt]{article}
\usepackage[utf8]{inputenc}
\usepackage[margin=2cm]{geometry}
\usepackage{array,booktabs,graphicx}
"""
_SPECIAL = str.maketrans(
    {
        "\0": "{}",  # no text has it: see `_escaped`
        "\\": r"\textbackslash{}",
        "{": r"\{",
        "}": r"\}",
        "~": r"\textasciitilde{}",
        "^": r"\textasciicircum{}",
        "`": r"\textasciigrave{}",
        '"': "''",
        "<": r"\textless{}",
        ">": r"\textgreater{}",
        "|": r"\textbar{}",
        "\N{EN DASH}": "--",
        "\N{MINUS SIGN}": "$-$",
        **{each: f"\\{each}" for each in "&%$#_"},
    }
)
BREAK = "\\allowbreak{}"
_WORDY = 14  # characters of a cell from which a column's lines are broken


def latex(document: Document) -> str:
    """The document as an article; pictures are .pdf files beside it."""
    parts = [
        f"{_HEAD}\\title{{{_text(document.title)}}}\n\\author{{}}\n\\date{{}}",
        "\\begin{document}\n\\maketitle",
        *_items([f"{name}: {value}" for name, value in document.facts]),
    ]
    for section in document.sections:
        parts += [f"\n\\section{{{_text(section.title)}}}"] if section.title else []
        for block in section.blocks:
            parts += ["", *_block(block)]
    return "\n".join([*parts, "\\end{document}", ""])


def latex_tables(document: Document) -> str:
    """The document's tables alone, without captions, for an article of the reader's own."""
    tables = ("\n".join([*_tabular(table), ""]) for table in document.tables)
    return "\n".join(["% needs \\usepackage{booktabs}", *tables])


def _block(block: Block) -> list[str]:
    match block:
        case str():
            return [_text(block)]
        case tuple():
            return _items(block)
        case Picture():
            return [
                "\\begin{figure}[htbp]\\centering",
                f"\\includegraphics[width={'' if block.is_wide else '0.55'}\\linewidth,"
                f"height=0.85\\textheight,keepaspectratio]{{{block.name}.pdf}}",
                f"\\caption{{{_text(block.caption)}}}",
                "\\end{figure}",
            ]
        case Table():
            return _table(block)


def _items(texts: Sequence[str]) -> list[str]:
    lines = (f"\\item {_text(text)}" for text in texts)
    return ["\\begin{itemize}", *lines, "\\end{itemize}"] if texts else []


def _table(block: Table) -> list[str]:
    return [
        "\\begin{table}[htbp]\\centering\\footnotesize\\setlength{\\tabcolsep}{4pt}",
        f"\\caption{{{_text(block.caption)}}}",
        "\\resizebox{\\ifdim\\width>\\linewidth\\linewidth\\else\\width\\fi}{!}{%",
        *_tabular(block)[:-1],
        "\\end{tabular}}",
        "\\end{table}",
    ]


def _tabular(block: Table) -> list[str]:
    return [
        f"\\begin{{tabular}}{{{block.sides}}}",
        "\\toprule",
        # Heads are longer than numbers: each word of them may stand on a line of its own.
        _row([_head(head) for head in block.heads]),
        "\\midrule",
        *(_row([_text(cell) for cell in row]) for row in block.rows),
        "\\bottomrule",
        "\\end{tabular}",
    ]


def _head(head: str) -> str:
    words = [_text(word) for word in head.split(" ")]
    if len(head) < _WORDY:
        return " ".join(words)
    lines = " \\\\ ".join(words)
    return f"\\begin{{tabular}}[b]{{@{{}}r@{{}}}}{lines}\\end{{tabular}}"


def _row(cells: list[str]) -> str:
    return " & ".join(cells) + " \\\\"


def _text(text: str) -> str:
    written = marked(text, _code, _escaped)
    # After the end of a row, or an \item, these would be part of the command.
    return "{}" + written if written.startswith(("[", "*")) else written


def _code(text: str) -> str:
    # A path may be broken where a line ends.
    return f"\\texttt{{{_escaped(text).replace('/', '/' + BREAK)}}}"


def _escaped(text: str) -> str:
    apart = re.sub("-(?=-)", "-\0", text)  # hyphens that stay hyphens
    # Names of the user's files may have letters that the fonts lack.
    return apart.translate(_SPECIAL).encode("ascii", "replace").decode("ascii")
