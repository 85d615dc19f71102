"""The harness itself: what the page does reaches the kernel, what the kernel says reaches the page."""

COUNTER = """
import anywidget, traitlets

class Counter(anywidget.AnyWidget):
    _esm = '''
    export default { render({ model, el }) {
      const button = document.createElement("button");
      const show = () => (button.textContent = `count ${model.get("count")}`);
      button.onclick = () => { model.set("count", model.get("count") + 1); model.save_changes(); };
      model.on("change:count", show);
      show();
      el.append(button);
    } };
    '''
    count = traitlets.Int(0).tag(sync=True)

counter = Counter()
counter
"""


def test_page_and_kernel_hear_each_other(notebook):
    it = notebook(COUNTER)
    button = it.run().locator("button", has_text="count")
    button.click()
    button.click()
    it.wait_until("counter.count == 2")
    it.tell("counter.count = 40")
    it.element.get_by_text("count 40").wait_for()
    button.click()
    it.wait_until("counter.count == 41")
