"""Draws what `tmux capture-pane -e -p` wrote as a picture: terminal_picture.py TEXT PNG"""

import re
import sys

from matplotlib import font_manager
from PIL import Image, ImageDraw, ImageFont

SIZE = 15
MARGIN = 12
INK, PAPER = "#E6E6E6", "#16181D"
COLORS = {31: "#FF6B5B", 32: "#5BD98A", 33: "#F2C14E"}
DIM = "#8A8F98"
SGR = re.compile(r"\x1b\[([\d;]*)m|\x1b[()]?.")


class Pen:
    """What the escape sequences have set."""

    def __init__(self):
        self.bold = self.dim = self.reverse = False
        self.color = None

    def obey(self, codes):
        for code in [int(code or 0) for code in codes.split(";")]:
            if code == 0:
                self.__init__()
            elif code in (1, 2, 7):
                setattr(self, {1: "bold", 2: "dim", 7: "reverse"}[code], True)
            elif code in COLORS or code == 39:
                self.color = COLORS.get(code)

    def colors(self):
        ink = self.color or (DIM if self.dim else INK)
        return (PAPER, ink) if self.reverse else (ink, PAPER)


def spans(line, pen):
    """Texts of one look each, with the pen as it is then."""
    at = 0
    for match in SGR.finditer(line):
        yield line[at:match.start()]
        if match.group(1) is not None:
            pen.obey(match.group(1))
        at = match.end()
    yield line[at:]


def main():
    source, target = sys.argv[1:3]
    with open(source, encoding="utf-8") as file:
        lines = file.read().splitlines()
    fonts = [ImageFont.truetype(font_manager.findfont(font_manager.FontProperties(
        family="DejaVu Sans Mono", weight=weight)), SIZE) for weight in ("normal", "bold")]
    width, height = fonts[0].getlength("m"), int(1.3 * SIZE)
    columns = max(len(SGR.sub("", line)) for line in lines)
    image = Image.new("RGB", (int(columns * width) + 2 * MARGIN,
                              len(lines) * height + 2 * MARGIN), PAPER)
    draw = ImageDraw.Draw(image)
    pen = Pen()
    for row, line in enumerate(lines):
        x, y = MARGIN, MARGIN + row * height
        for text in spans(line, pen):
            ink, paper = pen.colors()
            end = x + width * len(text)
            draw.rectangle((x, y, end, y + height - 1), fill=paper)
            draw.text((x, y), text, fill=ink, font=fonts[pen.bold])
            x = end
    image.quantize(32).save(target, optimize=True)


if __name__ == "__main__":
    main()
