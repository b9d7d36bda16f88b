"""Links the first mention of a term of the glossary on a page to its entry."""

from __future__ import annotations

import re

from docutils import nodes
from sphinx import addnodes
from sphinx.transforms import SphinxTransform

#: Pages on which a term is explained anyway, and words that mean too much else to be linked.
_LEFT_OUT = ("glossary", "conventions", "bibliography", "index", "reference/")
_WORDS = {"mobility", "traction", "course", "card", "yaw", "lug", "rut", "attitude", "skid"}
_ENTRY = re.compile(r"^(?=\S)(?!`)([^{}\n:]+)\n {2}", flags=re.M)


def terms(text: str) -> list[str]:
    """The terms that a glossary has, longest first."""
    found = {term.strip() for term in _ENTRY.findall(text)} - _WORDS
    return sorted(found, key=len, reverse=True)


class FirstMentions(SphinxTransform):
    default_priority = 300

    def apply(self) -> None:
        name = self.env.docname
        if name.startswith(_LEFT_OUT) or name not in self.env.found_docs or not self.app.config.glossary_terms:
            return
        left = dict.fromkeys(self.app.config.glossary_terms)
        for paragraph in list(self.document.findall(nodes.paragraph)):
            for text in [node for node in paragraph.children if isinstance(node, nodes.Text)]:
                # With a capital, Grouser is the software.
                words = "|".join(f"(?-i:{term})" if term == "grouser" else re.escape(term) for term in left)
                match = re.search(rf"\b({words})s?\b", text, flags=re.I) if words else None
                if match:
                    left.pop(match[1].lower())
                    before, after = text[: match.start()], text[match.end() :]
                    text.parent.replace(text, [nodes.Text(before), _link(match, name), nodes.Text(after)])


def _link(match: re.Match[str], name: str) -> nodes.Node:
    term = {"refdomain": "std", "reftype": "term", "reftarget": match[1].lower()}
    return addnodes.pending_xref("", nodes.inline("", match[0]), refdoc=name, refexplicit=True, refwarn=True, **term)
