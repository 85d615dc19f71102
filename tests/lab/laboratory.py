"""A JupyterLab of its own, opened in a real Chromium: notebooks are run by keyboard, and kernels can be asked."""

import json
import os
import re
import secrets
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import nbformat
from playwright.sync_api import Locator, Page

PATIENCE = 60  # seconds until something that should happen counts as failed; nothing here waits that long
WINDOW = {"width": 1280, "height": 1000}
OPTIONS = (
    "--no-browser",
    "--allow-root",  # containers run the tests as root
    "--ip=127.0.0.1",
    "--port=0",  # whichever is free
    "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate",
    "--LabApp.extension_manager=readonly",
    "--LabApp.expose_app_in_browser=True",  # so that a test can open notebooks and ask kernels
    "--LanguageServerManager.autodetect=False",
    "--ServerApp.terminals_enabled=False",
)
NEWS = {"fetchNews": "false", "checkForUpdates": False}
NEWS_FILE = "lab/user-settings/@jupyterlab/apputils-extension/notification.jupyterlab-settings"

OWN_AFFAIRS = "Canceled future for"  # JupyterLab asks a kernel about itself, and it is ended before it has answered

DONE = re.compile(r"\[\d+\]:")  # while a cell runs there is a star
FAILED = "[data-mime-type='application/vnd.jupyter.stderr'], [data-mime-type='application/vnd.jupyter.error']"
PANEL = "const panel = jupyterapp.shell.currentWidget, context = panel.sessionContext;"
OPEN = """async path => {
  const panel = await jupyterapp.commands.execute("docmanager:open", { path, factory: "Notebook" });
  await panel.revealed;
  await panel.sessionContext.ready;
  await panel.sessionContext.session.kernel.info;
}"""
ASK = f"""async expression => {{ {PANEL}
  const question = {{ answer: `__import__("json").dumps(${{expression}})` }};
  const request = {{ code: "", silent: true, store_history: false, user_expressions: question }};
  const {{ answer }} = (await context.session.kernel.requestExecute(request).done).content.user_expressions;
  if (answer.status !== "ok") throw new Error(`${{answer.ename}}: ${{answer.evalue}}`);
  return eval(answer.data["text/plain"]); // the representation of a str, whose content is JSON
}}"""
TELL = f"""async code => {{ {PANEL}
  const request = {{ code, silent: true, store_history: false }};
  const {{ content }} = await context.session.kernel.requestExecute(request).done;
  if (content.status !== "ok") throw new Error(`${{content.ename}}: ${{content.evalue}}`);
}}"""
UNTIL = f"""async expression => {{
  while (!JSON.parse(await ({ASK})(`bool(${{expression}})`))) await new Promise(again => setTimeout(again, 50));
}}"""
SHUT_DOWN = f"async () => {{ {PANEL} await context.shutdown(); }}"
SAVE = f"async () => {{ {PANEL} await panel.context.save(); }}"
KERNEL = {"kernelspec": {"name": "python3", "display_name": "Python 3"}}  # without it JupyterLab asks which
CLOSE = """async () => {
  const { serviceManager, shell, commands } = jupyterapp;
  for (const panel of [...shell.widgets("main")]) {
    await panel.context?.save(); // or it would ask whether to
    panel.dispose();
  }
  await serviceManager.sessions.shutdownAll();
  await commands.execute("apputils:change-theme", { theme: "JupyterLab Light" });
}"""


@contextmanager
def jupyterlab(home: Path) -> Iterator[str]:
    """Run a JupyterLab that knows nothing of this machine's settings, and yield its address with the token."""
    folders = {name: home / name for name in ("config", "data", "runtime", "ipython", "notebooks")}
    for folder in folders.values():
        folder.mkdir()
    news = folders["config"] / NEWS_FILE
    news.parent.mkdir(parents=True)
    news.write_text(json.dumps(NEWS))
    environment = {
        **{name: value for name, value in os.environ.items() if not name.startswith("JUPYTER")},
        "HOME": str(home),
        "IPYTHONDIR": str(folders["ipython"]),
        **{f"JUPYTER_{name.upper()}_DIR": str(folders[name]) for name in ("config", "data", "runtime")},
    }
    token = secrets.token_hex()
    command = [sys.executable, "-m", "jupyterlab", *OPTIONS, f"--IdentityProvider.token={token}"]
    with (home / "log").open("w") as log:
        server = subprocess.Popen(command, cwd=folders["notebooks"], env=environment, stdout=log, stderr=log)
        try:
            yield f"{address_of(server, folders['runtime'])}lab?reset&token={token}"
        finally:
            server.send_signal(signal.SIGTERM)  # kernels are shut down as well
            server.wait(PATIENCE)


def address_of(server: subprocess.Popen, runtime: Path) -> str:
    """Wait until the server has written down where it is."""
    for _ in range(20 * PATIENCE):
        for file in runtime.glob("jpserver-*.json"):
            with suppress(ValueError):  # it may be half written
                return json.loads(file.read_text())["url"]
        with suppress(subprocess.TimeoutExpired):
            raise RuntimeError(f"JupyterLab ended with {server.wait(1 / 20)}; its log is in {runtime.parent}.")
    raise RuntimeError(f"JupyterLab did not start; its log is in {runtime.parent}.")


def evaluate(page: Page, function: str, argument: Any = None) -> Any:
    """Call an asynchronous function in the page; Playwright itself would wait for ever."""
    late = f"setTimeout(() => no(new Error('no answer after {PATIENCE} s')), {1000 * PATIENCE})"
    return page.evaluate(f"x => Promise.race([({function})(x), new Promise((_, no) => {late})])", argument)


class Lab:
    """JupyterLab, open in a page; complaints are all that the browser has to say against it."""

    def __init__(self, page: Page, address: str, folder: Path):
        self.page = page
        self.address = address
        self.folder = folder
        self.complaints: list[str] = []
        page.set_default_timeout(1000 * PATIENCE)
        page.on("pageerror", lambda error: self.hear(f"script error: {error.stack or error}"))
        page.on("request", lambda request: self.see(request.url))
        page.on("console", lambda m: self.hear(f"console: {m.text}") if m.type == "error" else None)

    def see(self, url: str) -> None:
        """Write down what would need another server."""
        if not url.startswith((self.address.split("lab?")[0], "data:", "blob:")):
            self.complaints.append(f"asks for something outside: {url}")

    def hear(self, error: str) -> None:
        """Write down an error, unless it is one of JupyterLab's own affairs."""
        if OWN_AFFAIRS not in error:
            self.complaints.append(error)

    def open(self, name: str, *cells: str) -> "Notebook":
        """Write a notebook with these cells, and open it."""
        made = nbformat.v4.new_notebook(cells=[*map(nbformat.v4.new_code_cell, cells)], metadata=KERNEL)
        nbformat.write(made, self.folder / f"{name}.ipynb")
        return self.reopen(name)

    def reopen(self, name: str) -> "Notebook":
        """Open a notebook that is there, with the kernel that it has, if it has one."""
        evaluate(self.page, OPEN, f"{name}.ipynb")
        return Notebook(self.page, name)

    def load(self) -> None:
        """Load JupyterLab, for the first time or again; no notebook is open then."""
        self.page.goto(self.address)
        self.page.wait_for_function("window.jupyterapp")
        evaluate(self.page, "() => jupyterapp.restored.then(() => null)")

    def close(self) -> None:
        """Close all notebooks, end their kernels, and be as in the beginning."""
        evaluate(self.page, CLOSE)

    def theme(self, name: str) -> None:
        """Choose a theme of JupyterLab."""
        self.page.evaluate("theme => jupyterapp.commands.execute('apputils:change-theme', { theme })", name)
        self.page.wait_for_function("theme => document.body.dataset.jpThemeName === theme", arg=name)


class Notebook:
    """The notebook in front."""

    def __init__(self, page: Page, name: str):
        self.page = page
        self.name = name
        self.element = page.locator(".jp-NotebookPanel:visible")

    def cell(self, number: int = 0) -> Locator:
        """Return a cell of code."""
        return self.element.locator(".jp-CodeCell").nth(number)

    def output(self, number: int = 0) -> Locator:
        """Return the output of a cell."""
        return self.cell(number).locator(".jp-OutputArea-output").first

    def run(self, number: int = 0, fails: bool = False) -> Locator:
        """Run a cell by the keyboard, wait for its end, and return its output."""
        self.cell(number).locator(".cm-content").click()
        self.page.keyboard.press("Shift+Enter")
        self.cell(number).locator(".jp-InputPrompt", has_text=DONE).wait_for()
        if error := [] if fails else self.cell(number).locator(FAILED).all_inner_texts():
            raise RuntimeError(error[0])
        return self.output(number)

    def ask(self, expression: str) -> Any:
        """Return the value of an expression in the kernel; what the page tells it may still be on its way."""
        return json.loads(evaluate(self.page, ASK, expression))

    def tell(self, code: str) -> None:
        """Run code in the kernel without a cell."""
        evaluate(self.page, TELL, code)

    def wait_until(self, expression: str) -> None:
        """Wait until an expression in the kernel is true: the page tells it what happened a moment later."""
        evaluate(self.page, UNTIL, expression)

    def kill(self) -> None:
        """End the kernel as the system does it when memory is short."""
        os.kill(self.ask("__import__('os').getpid()"), signal.SIGKILL)

    def shut_down(self) -> None:
        """End the kernel as the menu does it."""
        evaluate(self.page, SHUT_DOWN)

    def save(self) -> None:
        """Store it with its outputs."""
        evaluate(self.page, SAVE)
