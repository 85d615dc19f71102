// What scrolls inside itself, a wide formula or table, must also scroll for readers without a mouse:
// it becomes a stop of the Tab key while it is wider than its place, and only then.
(() => {
  const wide = 'mjx-container[display="true"], .cell_output .text_html, .pst-scrollable-table-container';

  function update() {
    for (const element of document.querySelectorAll(wide)) {
      if (element.scrollWidth > element.clientWidth) element.tabIndex = 0;
      else element.removeAttribute("tabindex");
    }
  }

  window.addEventListener("load", async () => {
    await window.MathJax?.startup?.promise; // formulas have their width only now
    update();
    new ResizeObserver(update).observe(document.body);
  });
})();
