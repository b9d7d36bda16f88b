"""Equations: TeX of the chapters as MathML, at build time, by KaTeX.

The pages need no script and no other host for them. TeX that KaTeX does not understand is a warning, and
warnings fail the build. A letter with an index in a sentence, such as F_x, is set with a lowered index."""

from __future__ import annotations

import importlib.util
import re
from functools import cache
from pathlib import Path

import dukpy
from docutils import nodes
from sphinx.transforms.post_transforms import SphinxPostTransform
from sphinx.util import logging

#: What KaTeX is asked: `strict` makes an error of what it would only guess.
_CALL = "katex.renderToString(dukpy.tex, {output: 'mathml', displayMode: dukpy.display, strict: 'error'})"
_TAG = re.compile(r"\s*\\tag\{([^}]*)\}")
#: One letter, perhaps primed, and its index: F_x, k'_φ, θ_f, v_des; or a power: m^(n+1).
_INDEXED = re.compile(r"(?<![\w\\.])([A-Za-zα-ωΑ-Ω]['’]?)(?:_([A-Za-zα-ω]{1,4}|[0-9])(?![\w'(])|\^\(([^()]+)\))")
_THIN = '<mspace width="0.17em"/>'
_FUNCTION = r"<mi>(?:sin|cos|tan|cot|arccos|max|min)</mi>"
#: What KaTeX leaves to its own layout, and browsers do not add: space around functions, none behind a sign.
_SPACES = (
    (re.compile(rf"(</(?:mi|mn|msub|msup|mfrac)>|\)</mo>)(?=(?:<msup>)?(?:<mrow>)?{_FUNCTION})"), rf"\1{_THIN}"),
    (re.compile(r"(<mo>\u2061</mo>(?:</mrow>)?(?:<mn>\d</mn></msup>)?)(?=<mi|<ms|<mf)"), rf"\1{_THIN}"),
    (re.compile(r"(<mo>[=≤,]</mo>|\(</mo>|\[</mo>|^<mrow>)<mo>([−±])</mo>"), r'\1<mo form="prefix">\2</mo>'),
)


def font() -> str:
    """The file of the font that the equations are set in."""
    return str(_of_package("ziamath") / "fonts" / "STIXTwoMath-Regular.ttf")


def _of_package(name: str) -> Path:
    # Found without being imported: one imports all that it draws with, the other its Sphinx extension.
    found = importlib.util.find_spec(name)
    if found is None or found.origin is None:
        raise ImportError(f"{name} is not installed")
    return Path(found.origin).parent


@cache
def _interpreter() -> dukpy.JSInterpreter:
    interpreter = dukpy.JSInterpreter()
    script = _of_package("sphinxcontrib.katex") / "katex.min.js"
    interpreter.evaljs(script.read_text(encoding="utf-8"))
    return interpreter


@cache
def _mathml(tex: str, display: bool) -> str:
    html = _interpreter().evaljs(_CALL, tex=tex, display=display)
    mathml = re.sub(r"^<span[^>]*>|</span>$", "", html)
    for pattern, replacement in _SPACES:
        mathml = pattern.sub(replacement, mathml)
    return mathml


def _rendered(node, display: bool) -> tuple[str, str]:
    """MathML and the tag of an equation; its TeX as text where there is an error in it."""
    tex = node.astext()
    tag = _TAG.search(tex)
    try:
        mathml = _mathml(_TAG.sub("", tex).strip(), display)
    except dukpy.JSRuntimeError as error:
        reason = str(error).split("\n", 1)[0]
        logging.getLogger(__name__).warning("%s: %s", reason, tex, location=node)
        mathml = f"<code>{nodes.unescape(tex)}</code>"
    return mathml, tag[1] if tag else ""


def inline(writer, node) -> None:
    writer.body.append(f'<span class="math">{_rendered(node, display=False)[0]}</span>')
    raise nodes.SkipNode


def displayed(writer, node) -> None:
    mathml, tag = _rendered(node, display=True)
    anchor = f' id="eq-{tag.lower()}"' if tag else ""
    number = f'<span class="eqno">({tag})</span>' if tag else ""
    # A wide one is scrolled, also with the keyboard.
    scrolled = f'<div class="equation" tabindex="0" role="group" aria-label="Equation {tag}">{mathml}</div>'
    writer.body.append(f'<div class="math"{anchor}>{scrolled}{number}</div>\n')
    raise nodes.SkipNode


class Indices(SphinxPostTransform):
    """Sets the letters with an index that stand in sentences and tables."""

    default_priority = 900
    formats = ("html",)

    def run(self) -> None:
        apart = (nodes.literal, nodes.FixedTextElement, nodes.math, nodes.math_block, nodes.raw, nodes.title)
        for text in list(self.document.findall(nodes.Text)):
            parents = _parents(text)
            if not _INDEXED.search(text) or any(isinstance(one, apart) or _is_code(one) for one in parents):
                continue
            pieces: list[nodes.Node] = []
            end = 0
            for match in _INDEXED.finditer(text):
                letter, index, power = match.groups()
                pieces.append(nodes.Text(text[end : match.start()]))
                pieces.append(nodes.emphasis("", letter) if index else nodes.Text(letter))
                pieces.append(nodes.subscript("", index) if index else nodes.superscript("", power))
                end = match.end()
            pieces.append(nodes.Text(text[end:]))
            text.parent.replace(text, [piece for piece in pieces if piece.astext()])


def _parents(node):
    while node.parent is not None:
        node = node.parent
        yield node


def _is_code(node) -> bool:
    """What Sphinx makes of code: signatures, names of the package and their descriptions."""
    return node.__class__.__name__.startswith(("desc", "pending_xref")) and node.tagname != "desc_content"


def setup(app) -> None:
    app.add_html_math_renderer("katex", inline_renderers=(inline, None), block_renderers=(displayed, None))
    app.add_post_transform(Indices)
