"""Words in rows that fit a terminal: a row is a label and chunks, a chunk is never torn if it fits
into a line."""

import textwrap

LABEL_WIDTH = 9
GAP = "  "
CUT = "~"   # the rest did not fit

PLAIN, BOLD, GOOD, WARN, BAD, DIM, BAR = "", "bold", "good", "warn", "bad", "dim", "bar"


def printable(text):
    """What vehicles and networks say goes to the terminal as plain characters only: an escape
    sequence in it must not take the terminal over."""
    return "".join(char if " " <= char <= "~" else "?" for char in text)


class Row:
    """`chunks` are pairs of text and style. Of two rows the one with the greater `importance` keeps
    its lines when room is short."""

    def __init__(self, label, chunks, importance=1):
        self.label = label
        self.chunks = [(printable(text), style) for text, style in chunks if text]
        self.importance = importance


def clip(spans, width):
    """The part of a line that fits. A cut is marked: half a number must not look like one."""
    room, kept = width, []
    for text, style in spans:
        if room > 0 and text:
            kept.append((text[:room], style))
        room -= len(text)
    if room < 0 and kept:
        text, style = kept[-1]
        kept[-1] = (text[:-1] + CUT, style)
    return kept


def label_span(row, width):
    indent = min(LABEL_WIDTH, width // 4)
    return (row.label[:max(indent - 1, 0)].ljust(indent), BOLD)


NEW_LINE = object()


def pieces(text, used, indent, width):
    """The text in lines: in one piece if a line can hold it, else torn between words."""
    room = width - indent
    if used + len(text) <= width or room < 1:
        return [text]
    if len(text) <= room:
        return [NEW_LINE, text]
    # The mark stands for what is in the line already, so that the text begins behind it.
    torn = textwrap.wrap(text, room, initial_indent="\0" * min(used - indent, room - 1))
    parts = []
    for part in torn:
        parts += [NEW_LINE, part.lstrip("\0")]
    return parts[1:]


def flow(row, width):
    """The row as lines, each a list of spans, none longer than `width`."""
    label = label_span(row, width)
    indent = used = len(label[0])
    lines = [[label]]
    for chunk, style in row.chunks:
        gap = GAP if used > indent else ""
        for text in pieces(chunk, used + len(gap), indent, width):
            if text is NEW_LINE:
                lines.append([(" " * indent, PLAIN)])
                used, gap = indent, ""
                continue
            lines[-1] += [(gap, PLAIN), (text, style)]
            used += len(gap) + len(text)
    return [clip(line, width) for line in lines]


def one_line(row, width):
    spans = [label_span(row, width)]
    for number, (text, style) in enumerate(row.chunks):
        spans += [(GAP if number else "", PLAIN), (text, style)]
    return [clip(spans, width)]


def fitted(rows, width, height):
    """All rows as lines, `height` at most: the least important ones are cut to one line first, and
    then left out, from the last."""
    blocks = [flow(row, width) for row in rows]
    by_need = sorted(range(len(rows)), key=lambda i: (rows[i].importance, -i))
    for shorter in (one_line, lambda row, width: []):
        for i in by_need:
            if sum(map(len, blocks)) <= height:
                break
            if blocks[i]:
                blocks[i] = shorter(rows[i], width)
    return [line for block in blocks for line in block]


def text_of(line):
    return "".join(text for text, _ in line)
