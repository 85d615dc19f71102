"""The built book, and a chapter with one of everything, each built once for all the tests of this folder."""

import shutil
from textwrap import dedent

import nbformat
import pytest

import browsing
import sample
import vendor
from building import ROOT, build, once

TOC = """
format: jb-book
root: book/sample
chapters:
  - file: book/other
  - file: book/bibliography
"""


@pytest.fixture(scope="session")
def book(tmp_path_factory, worker_id):
    """The folder of the book's pages, for all workers. Always a fresh build: a stale page would prove nothing."""
    own = tmp_path_factory.getbasetemp()
    this_run = own if worker_id == "master" else own.parent
    return once(this_run / "book", lambda: build(ROOT, tmp_path_factory.mktemp("book")) / "html")


@pytest.fixture(scope="session")
def sample_source(tmp_path_factory):
    """A book of two pages with the real book's configuration, look and extensions."""
    source = tmp_path_factory.mktemp("sample")
    vendor.fetch(vendor.PACKAGES["mathjax"])
    for part in ("_config.yml", "book/references.bib"):
        (source / part).parent.mkdir(exist_ok=True)
        shutil.copy(ROOT / part, source / part)
    for part in ("book/_ext", "book/_static", "book/_templates", "tools"):
        shutil.copytree(ROOT / part, source / part)
    nbformat.write(sample.notebook(), source / "book/sample.ipynb")
    (source / "book/other.md").write_text(dedent(sample.OTHER))
    shutil.copy(ROOT / "book/bibliography.md", source / "book")
    (source / "_toc.yml").write_text(TOC)
    return source


@pytest.fixture(scope="session")
def sample_book(sample_source):
    """The folder of the sample's pages."""
    return build(sample_source, sample_source) / "html"


@pytest.fixture(scope="module")
def browser():
    """A Chromium, for the tests of one file."""
    with browsing.launched() as browser:
        yield browser


@pytest.fixture(scope="module")
def address(book):
    """Where the book is served."""
    with browsing.served(book) as address:
        yield address


@pytest.fixture(scope="module")
def sample_address(sample_book):
    """Where the sample is served."""
    with browsing.served(sample_book) as address:
        yield address
