"""One JupyterLab for all the tests of this folder; each test has notebooks and kernels of its own."""

from itertools import count

import pytest

import browsing

from .laboratory import WINDOW, Lab, jupyterlab

NUMBERS = count()


@pytest.fixture(scope="session")
def server(tmp_path_factory):
    """The address of a JupyterLab, and the folder of its notebooks."""
    home = tmp_path_factory.mktemp("jupyterlab")
    with jupyterlab(home) as address:
        yield address, home / "notebooks"


@pytest.fixture(scope="module")
def open_lab(server):
    """JupyterLab, open in a browser. For one file only: two of these browsers at a time cannot be."""
    address, folder = server
    with browsing.launched() as browser:
        lab = Lab(browser.new_context(viewport=WINDOW).new_page(), address, folder)
        lab.load()
        yield lab


@pytest.fixture
def lab(open_lab):
    """JupyterLab in its light theme; when the test is over, the browser must have no complaint about it."""
    open_lab.complaints.clear()
    yield open_lab
    open_lab.close()
    assert open_lab.complaints == []


@pytest.fixture
def notebook(lab):
    """Open a notebook with some cells, and a kernel of its own."""
    return lambda *cells: lab.open(f"notebook-{next(NUMBERS)}", *cells)
