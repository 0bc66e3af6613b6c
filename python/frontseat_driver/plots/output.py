"""Writes the page as a picture, or as one HTML file that needs nothing else."""

import html
import io
import os
import re

import matplotlib

from frontseat_driver.plots import page
from frontseat_driver.plots.mission import summary

DOTS_PER_INCH = 100
# No date inside: the same recording gives the same file.
NO_DATE = {"Date": None}

TEMPLATE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>{title}</title>
<style>
body {{ font-family: sans-serif; margin: 1em; color: #222; }}
svg {{ width: 100%; height: auto; }}
td, th {{ text-align: left; padding: 0.2em 1.2em 0.2em 0; border-bottom: 1px solid #ddd; }}
th {{ font-weight: normal; color: #555; }}
</style>
</head>
<body>
<h1>{title}</h1>
{svg}
<table>
{rows}
</table>
</body>
</html>
"""


def write(mission, path):
    with matplotlib.rc_context(page.STYLE):
        write_styled(mission, path)


def write_styled(mission, path):
    figure = page.figure_of(mission)
    ending = os.path.splitext(path)[1].lower()
    if ending == ".png":
        figure.savefig(path, format="png", dpi=DOTS_PER_INCH)
    elif ending == ".svg":
        figure.savefig(path, format="svg", metadata=NO_DATE)
    else:
        with open(path, "w", encoding="utf-8") as file:
            file.write(html_page(mission, figure))


def html_page(mission, figure):
    picture = io.StringIO()
    figure.savefig(picture, format="svg", metadata=NO_DATE)
    svg = re.sub(r".*?(?=<svg)", "", picture.getvalue(), count=1, flags=re.S)
    rows = "\n".join("<tr><th>%s</th><td>%s</td></tr>" % (html.escape(name), html.escape(value))
                     for name, value in summary(mission))
    return TEMPLATE.format(title=html.escape(mission.title), svg=svg, rows=rows)
