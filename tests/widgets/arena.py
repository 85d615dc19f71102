"""The simulator, in a page or in the output of a cell: its map, its buttons, its words."""

import re

from playwright.sync_api import Locator, expect

LEFT, EDGE = 22, 3  # pixels beside the cells: coordinates at the left and below, a thin frame at the other sides


class Arena:
    """Operate a simulator as its user does."""

    def __init__(self, around: Locator, number: int = 0):
        self.element = around.locator(".rlnav").nth(number)
        self.page = around.page
        self.map = self.element.get_by_role("application", name="Map of the robot's world")
        self.map.wait_for()

    @property
    def words(self) -> str:
        """What a screen reader tells of the map."""
        return self.page.locator(f"[id='{self.map.get_attribute('aria-describedby')}']").text_content()

    def says(self, text: str) -> None:
        """Wait until the description of the map has a text."""
        expect(self.map).to_have_accessible_description(re.compile(re.escape(text)))

    def at(self, x: int, y: int) -> tuple[float, float]:
        """Return where the middle of a cell is on the screen."""
        self.map.scroll_into_view_if_needed()
        right, down = self.within(x, y)
        box = self.map.bounding_box()
        return box["x"] + right, box["y"] + down

    def within(self, x: int, y: int) -> tuple[float, float]:
        """Return where the middle of a cell is on the map."""
        width, height = map(int, re.match(r"(\d+) by (\d+)", self.words).groups())
        cell = (self.map.bounding_box()["width"] - LEFT - EDGE) / width
        return LEFT + (x + 0.5) * cell, EDGE + (height - y - 0.5) * cell

    def drag(self, *cells: tuple[int, int]) -> None:
        """Press on the first cell, go over the others, and let go."""
        (x, y), *others = (self.within(*cell) for cell in cells)
        self.map.hover(position={"x": x, "y": y})  # brings it into view, and sees that nothing lies above it
        self.page.mouse.down()
        box = self.map.bounding_box()
        for x, y in others:
            self.page.mouse.move(box["x"] + x, box["y"] + y, steps=4)
        self.page.mouse.up()

    def press(self, name: str) -> None:
        """Press a button."""
        self.element.get_by_role("button", name=name, exact=True).click()

    def open(self, group: str) -> Locator:
        """Open a group of settings."""
        summary = self.element.locator("summary", has_text=re.compile(f"^{group}"))
        summary.click()
        return self.element.locator("details", has=self.page.locator("summary", has_text=re.compile(f"^{group}")))

    def wait_for(self, text: str) -> None:
        """Wait until a text can be seen."""
        self.element.get_by_text(re.compile(text)).first.wait_for()
