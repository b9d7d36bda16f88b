"""What Sphinx has to learn to make this site: pages made from the program and from the schemas, links that
leave the site, docstrings of re-exported names, equations, links to
the glossary, notebooks to download, and a count at the end."""

from pathlib import Path

from pygments.lexers import TextLexer

from . import count, documents, equations, glossary, links, notebooks, program, reexports


def setup(app):
    # What programs read needs no colours, and the name of no language may be unknown.
    app.add_lexer("csv", TextLexer)
    equations.setup(app)
    found = glossary.terms(Path(app.srcdir, "glossary.md").read_text(encoding="utf-8"))
    app.add_config_value("glossary_terms", found, "env")
    app.add_transform(glossary.FirstMentions)
    app.connect("html-page-context", notebooks.offer)
    # Before autosummary makes its own pages.
    app.connect("builder-inited", program.write_pages, priority=100)
    app.connect("builder-inited", documents.write_pages, priority=100)
    app.connect("builder-inited", reexports.gather, priority=100)
    app.connect("builder-inited", reexports.complete)
    app.connect("autodoc-process-signature", reexports.signature)
    app.connect("missing-reference", reexports.from_below)
    app.connect("source-read", links.lead_outside)
    app.connect("doctree-read", count.cells)
    app.connect("build-finished", count.tell)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
