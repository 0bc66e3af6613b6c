"""Finds, in C++ text, what a slip of the pen could have got wrong: one rule for each kind of slip.

Nothing here knows the sources: a rule goes by the tokens, and by the house style (clang-format puts
spaces around operators, and none around the brackets of templates).
"""

import bisect
import re

TOKEN = re.compile(
    r"""
    (?P<space>\s+|//[^\n]*|/\*.*?\*/|^[ ]*\#[^\n]*)
  | (?P<text>"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+')
  | (?P<number>(?:0[xX][0-9a-fA-F']+|(?:\d[\d']*\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\w*)
  | (?P<word>[A-Za-z_]\w*)
  | (?P<sign><<=|>>=|->|\+\+|--|&&|\|\||[<>=!+\-*/%&|^]=|::|<<|>>|.)
    """,
    re.VERBOSE | re.DOTALL | re.MULTILINE)
DURATION = re.compile(r"^(\d+)(h|min|s|ms|us|ns)$")
DECIMAL = re.compile(r"^((?:\d+\.\d*|\.\d+)(?:[eE][+-]?\d+)?|\d+[eE][+-]?\d+)([fF]?)$")
WHOLE = re.compile(r"^([1-9]\d*)([uUlL]*)$")

ARITHMETIC = {"+": "-", "-": "+", "*": "/", "/": "*", "+=": "-=", "-=": "+=", "*=": "/=",
              "/=": "*="}
NEGATED = {"<": ">=", ">=": "<", ">": "<=", "<=": ">", "==": "!=", "!=": "=="}
EDGE = {"<": "<=", "<=": "<", ">": ">=", ">=": ">"}
LOGIC = {"&&": "||", "||": "&&"}
FUNCTIONS = {"sin": "cos", "cos": "sin", "asin": "acos", "acos": "asin", "min": "max",
             "max": "min", "floor": "ceil", "ceil": "floor", "M_PI": "M_PI_2", "M_PI_2": "M_PI",
             "radians": "degrees", "degrees": "radians"}
AXES = (("x", "y", "z"), ("roll", "pitch", "yaw"), ("surge", "sway", "heave"), ("north", "east"),
        ("northing", "easting"), ("latitude", "longitude"), ("port", "starboard"),
        ("left", "right"), ("lowest", "highest"), ("horizontal", "vertical"),
        ("linear", "angular"))
OTHER_AXES = {name: group[i + 1:] + group[:i] for group in AXES for i, name in enumerate(group)}
CLOCK_UNITS = ("hours", "minutes", "seconds", "milliseconds", "microseconds", "nanoseconds")
NOT_TYPES = ("return", "case", "else", "co_return", "throw", "new")
RULES = ("sign", "scale", "axis", "order", "time", "compare", "edge", "logic")


class Mutation:
    """One change of one place of a file."""

    def __init__(self, path, rule, line, old, new, text):
        self.path = path  # relative to the repository
        self.rule = rule
        self.line = line  # counts from 1
        self.old = old  # the line before and after, without the spaces around
        self.new = new
        self.text = text  # the whole file after

    def key(self):
        return self.path, self.old, self.new


class Token:
    def __init__(self, kind, text, start):
        self.kind = kind
        self.text = text
        self.start = start
        self.end = start + len(text)
        self.spaced = False  # with white space before and after


def tokens_of(text):
    found = []
    for match in TOKEN.finditer(text):
        if match.lastgroup == "space":
            continue
        token = Token(match.lastgroup, match.group(), match.start())
        before, after = text[token.start - 1:token.start], text[token.end:token.end + 1]
        token.spaced = before.isspace() and after.isspace()
        found.append(token)
    return found


class Source:
    """A file, and each place where a rule applies as (rule, start, end, replacement)."""

    def __init__(self, path, text, known_words):
        self.path = path
        self.text = text
        self.known = known_words
        self.tokens = tokens_of(text)
        self.own = {token.text for token in self.tokens}
        self.line_starts = [0] + [m.end() for m in re.finditer("\n", text)]
        self.statements = self._statements()

    def mutations(self, rules=RULES):
        places = []
        for i in range(len(self.tokens)):
            places += [place for place in self._at(i) if place[0] in rules]
        if "order" in rules:
            places += self._orders()
        done = set()
        for place in sorted(places, key=lambda place: place[1]):
            mutation = self._mutation(*place)
            if mutation.text not in done and mutation.text != self.text:
                done.add(mutation.text)
                yield mutation

    def _mutation(self, rule, start, end, replacement):
        text = self.text[:start] + replacement + self.text[end:]
        line = bisect.bisect_right(self.line_starts, start)
        begin = self.line_starts[line - 1]
        old_end = self.text.find("\n", end)
        new_end = old_end + len(text) - len(self.text)
        old, new = self.text[begin:old_end], text[begin:new_end]
        return Mutation(self.path, rule, line, " ".join(old.split()), " ".join(new.split()), text)

    def _statements(self):
        """The first and last token of the statement that each token is in."""
        bounds = []
        start = 0
        for i, token in enumerate(self.tokens):
            if token.text in (";", "{", "}"):
                bounds += [(start, i)] * (i + 1 - start)
                start = i + 1
        bounds += [(start, len(self.tokens) - 1)] * (len(self.tokens) - start)
        return bounds

    def _statement(self, i):
        first, last = self.statements[i]
        return self.tokens[first:last + 1]

    def _at(self, i):
        token = self.tokens[i]
        if token.kind == "sign":
            yield from self._sign(i, token)
        elif token.kind == "number":
            yield from self._number(i, token)
        elif token.kind == "word":
            yield from self._word(i, token)

    def _previous(self, i):
        return self.tokens[i - 1] if i > 0 else Token("sign", ";", 0)

    def _next(self, i):
        return self.tokens[i + 1] if i + 1 < len(self.tokens) else Token("sign", ";", 0)

    # --- Operators ---

    def _sign(self, i, token):
        previous = self._previous(i)
        if previous.text == "operator" or self._in_loop_head(i):
            return
        if token.text == "-" and self._unary(previous):
            yield "sign", token.start, token.end, ""
        elif token.text == "!":
            yield "logic", token.start, token.end, ""
        elif token.spaced:
            yield from self._binary(i, token)

    def _binary(self, i, token):
        for rule, table in (("compare", NEGATED), ("edge", EDGE), ("logic", LOGIC)):
            if token.text in table:
                yield rule, token.start, token.end, table[token.text]
        if token.text in ARITHMETIC and not self._joins_text(i):
            rule = "sign" if token.text[0] in "+-" else "scale"
            yield rule, token.start, token.end, ARITHMETIC[token.text]

    @staticmethod
    def _unary(previous):
        if previous.kind in ("number", "text"):
            return False
        if previous.kind == "word":
            return previous.text in NOT_TYPES
        return previous.text not in (")", "]", "}")

    def _joins_text(self, i):
        words = ("to_string", "string", "string_view", "c_str", "text", "name", "data", "begin")
        return any(token.kind == "text" or token.text in words for token in self._statement(i))

    def _in_loop_head(self, i):
        """`for (int i = 0; i < n; ++i)`: a loop is no conversion, and one that never ends no test."""
        first = self.statements[i][0]
        for start in (first, self.statements[first - 1][0] if first > 0 else first):
            if self.tokens[start].text == "for" and ":" not in self._head(start):
                return i - start < len(self._head(start))
        return False

    def _head(self, start):
        depth = 0
        head = []
        for token in self.tokens[start:start + 60]:
            head.append(token.text)
            depth += {"(": 1, ")": -1}.get(token.text, 0)
            if depth == 0 and token.text == ")":
                break
        return head

    # --- Numbers ---

    def _number(self, i, token):
        duration = DURATION.match(token.text)
        decimal = DECIMAL.match(token.text)
        whole = WHOLE.match(token.text)
        if duration and int(duration.group(1)):
            count, unit = int(duration.group(1)), duration.group(2)
            yield "time", token.start, token.end, "%d%s" % (2 * count, unit)
            yield "time", token.start, token.end, "%d%s" % (count // 2, unit)
        elif decimal:
            yield from self._decimal(i, token, float(decimal.group(1)), decimal.group(2))
        elif whole and self._is_time(i):
            yield "time", token.start, token.end, str(2 * int(whole.group(1)))
            yield "time", token.start, token.end, str(int(whole.group(1)) // 2)
        elif whole and any(other.text == "constexpr" for other in self._statement(i)[:3]):
            yield "scale", token.start, token.end, str(2 * int(whole.group(1))) + whole.group(2)

    def _decimal(self, i, token, value, suffix):
        """A tenth more; a zero becomes one, unless it is only what a variable is born with."""
        if value != 0.0:
            yield "scale", token.start, token.end, repr(value * 1.1) + suffix
        elif not (self._previous(i).text in ("=", "{") and self._next(i).text in (";", ",", "}")):
            yield "scale", token.start, token.end, "1.0" + suffix

    def _is_time(self, i):
        """`std::chrono::seconds(3)`, `std::chrono::seconds kPatience{3}`, `nanoseconds{3}`."""
        before = [token.text for token in self.tokens[max(0, i - 3):i]]
        return bool(before) and before[-1] in ("(", "{", "=") and any(
            word in CLOCK_UNITS for word in before[:-1])

    # --- Names ---

    def _word(self, i, token):
        previous = self._previous(i)
        declares = (previous.kind == "word" and previous.text not in NOT_TYPES) or (
            previous.text in ("&", "*", ">", "&&") and not previous.spaced)
        if declares or previous.text == "operator":
            return
        if token.text in FUNCTIONS and (token.text[0] == "M" or self._next(i).text == "("):
            if not (self._previous(i).text == "::" and "limits" in self._text_before(i)):
                yield "scale", token.start, token.end, FUNCTIONS[token.text]
        yield from self._axis(i, token, previous)

    def _text_before(self, i):
        return self.text[max(0, self.tokens[i].start - 60):self.tokens[i].start]

    def _axis(self, i, token, previous):
        parts = token.text.split("_")
        for at, part in enumerate(parts):
            if part not in OTHER_AXES or self._said_again(i, part):
                continue
            names = ["_".join(parts[:at] + [other] + parts[at + 1:]) for other in OTHER_AXES[part]]
            variable = previous.text not in (".", "->", "::")  # one of this file, then
            names = [name for name in names if name in (self.own if variable else self.known)]
            names.sort(key=lambda name: name not in self.own)
            if names:
                yield "axis", token.start, token.end, names[0]

    def _said_again(self, i, part):
        """On the left of `out.roll = in.roll`: the slip on the right is the same one."""
        if self._next(i).text != "=":
            return False
        last = self.statements[i][1]
        return any(part in token.text.split("_") for token in self.tokens[i + 2:last + 1])

    # --- Lines ---

    def _orders(self):
        """Two fields of a sentence the other way round: neighbours that read or write one each."""
        field = re.compile(r"^ *(?:\w+\.\w+ = .*\bin\b.*|out\.\w+\([^{]*\));$")
        lines = self.text.split("\n")
        for i in range(len(lines) - 1):
            first, second = lines[i], lines[i + 1]
            if field.match(first) and field.match(second) and first != second:
                start = self.line_starts[i]
                end = self.line_starts[i + 1] + len(second)
                yield "order", start, end, second + "\n" + first


def words_of(text):
    return set(re.findall(r"[A-Za-z_]\w*", text))
