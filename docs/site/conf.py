"""How the documentation site is built: `cargo xtask site`. Its pages are the Markdown files of `docs/`."""

import os
import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))

import grouser  # noqa: E402
from grouser_site import equations, figures  # noqa: E402
from numpydoc import xref  # noqa: E402

project = "Grouser"
author = "The Grouser developers"
copyright = author
release = version = grouser.__version__

extensions = [
    "myst_nb",
    "numpydoc",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx_design",
    "sphinx_copybutton",
    "grouser_site",
]
exclude_patterns = ["site"]
# Beside this file; a relative one would be sought beside the pages.
templates_path = [str(HERE / "templates")]

# Links and headings as the code host has them.
myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
myst_dmath_double_inline = True
# Displayed equations are blocks of the language `math`, which the code host sets too.
myst_fence_as_directive = ["math"]
html_math_renderer = "katex"
myst_heading_anchors = 6
# What has no colours of its own is shown as it is.
highlight_language = "text"

# Every notebook is run at every build. An error of a cell is a warning with its traceback, and warnings fail the
# build at its end, so that one build shows all that is wrong.
nb_execution_mode = "force"
nb_execution_show_tb = True
nb_execution_timeout = 300
nb_output_stderr = "warn"
# MuJoCo draws without a display. Where it cannot (`cargo xtask site` finds out), its notebook is shown, not run.
if os.environ.setdefault("MUJOCO_GL", "egl") == "disable":
    nb_execution_excludepatterns = ["notebooks/mujoco.md"]
os.environ["MATPLOTLIBRC"] = figures.settings()

# Types stand in the text of the docstrings, with shapes and units.
autodoc_typehints = "none"
autodoc_member_order = "bysource"
autosummary_generate = True
toc_object_entries_show_parents = "hide"
default_role = "py:obj"
# Types in docstrings are words; those that are names of the package are links.
numpydoc_xref_param_type = True
numpydoc_xref_aliases = {name: f"grouser.{name}" for name in grouser.__all__}
numpydoc_xref_ignore = "all"
xref.DEFAULT_LINKS.clear()
numpydoc_show_class_members = False
numpydoc_class_members_toctree = False

html_theme = "pydata_sphinx_theme"
html_title = "Grouser"
html_static_path = ["static", equations.font()]
html_css_files = ["grouser.css"]
html_show_sourcelink = False
html_copy_source = False
html_theme_options = {
    "navbar_end": ["theme-switcher"],
    "header_links_before_dropdown": 6,
    "navigation_with_keys": False,
    "show_toc_level": 2,
    "secondary_sidebar_items": ["page-toc", "notebook.html"],
    "footer_start": ["copyright"],
    "footer_end": [],
    # Colours with enough contrast.
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
    # Without the buttons that unfold parts of it, which have no name that is read out.
    "collapse_navigation": True,
}
html_sidebars = {"index": [], "gallery": []}
