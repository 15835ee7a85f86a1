"""The language of the markers before measured numbers in the READMEs.

    <!--= EXPRESSION as FORMAT -->12.6     the text behind the marker is the expression's value
    <!--= holds: EXPRESSION -->            the expression is true; no text
    <!--: name = EXPRESSION -->            a name for a value, for the markers below it in the same file
    <!--= measured: COMMAND, 2026-11-22 -->0.75    no committed data; how to repeat it, and the date
    <!--= constant: FILE -->20             a number from the source

EXPRESSION: numbers, places, + - * / with spaces around them, ( ), min(…), max(…), sum(…), count(…), and
< <= > >= = in `holds`.
A place is a file of results/ or a name, and steps, as in
results/accuracy/summary.json#/[model=lod & cells>=32]/ms_per_frame:
    key, 'a key with / or spaces'            a value of an object, or of every object in a list
    number                                   an entry of a list
    [key=value & settings/substeps>4]        entries of a list: = != < <= > >= ^= (begins with);
                                             a value may be a name's place
    least:key, most:key, sort:key            an entry of a list; the list in that order
The content of a .csv file is a list of objects, that of an .html page is {caption: list of objects} of its
tables.
FORMAT: name (text), or as in Python: .3g, .1f, `,.0f` (16 641).
A marker has no | (it would end a table's cell) and no -- (it would end the comment). It begins no line (it
would end the paragraph).
"""
import csv
import functools
import json
import operator
import re
from html.parser import HTMLParser
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MARKER = re.compile(r"<!--(?P<kind>[=:])\s*(?P<body>.*?)\s*-->")
NUMBER_TEXT = re.compile(r"[-−]?\d+(?: \d{3}(?!\d))*(?:\.\d+)?")
NAME_TEXT = re.compile(r"\w+")
MEASURED = re.compile(r"measured: .+, \d{4}-\d\d-\d\d$")


# Data -----------------------------------------------------------------------------------------------------

class Tables(HTMLParser):
    """{caption: rows as {column: cell}} of a page; the first table of each caption."""

    def __init__(self):
        super().__init__()
        self.found, self._caption, self._rows, self._into = {}, "", [], None

    def handle_starttag(self, tag, attributes):
        if tag == "table":
            self._caption, self._rows = "", []
        elif tag == "tr":
            self._rows.append([])
        elif tag in ("td", "th") and self._rows:
            self._rows[-1].append("")
        if tag in ("caption", "td", "th"):
            self._into = tag

    def handle_endtag(self, tag):
        if tag in ("caption", "td", "th"):
            self._into = None
        elif tag == "table" and self._rows:
            self.found.setdefault(self._caption, [dict(zip(self._rows[0], row)) for row in self._rows[1:]])

    def handle_data(self, data):
        if self._into == "caption":
            self._caption += data
        elif self._into and self._rows and self._rows[-1]:
            self._rows[-1][-1] += data


@functools.cache
def data(file):
    """The content of a file in results/."""
    path = ROOT / file
    if not path.is_file():
        raise ValueError(f"there is no {file}")
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".json":
        return json.loads(text)
    if path.suffix == ".csv":
        return list(csv.DictReader(text.splitlines()))
    tables = Tables()
    tables.feed(text)
    return tables.found


# The language ---------------------------------------------------------------------------------------------

STEP = r"(?:/(?:\[[^\]]*\]|'[^']*'|[^\s/()',\[\]]+))"
TOKEN = re.compile(rf"""\s*(?:(?P<function>(?:min|max|sum|count)\()
    |(?P<place>(?:results/[\w./-]+\#|[a-z_]\w*){STEP}*)
    |(?P<number>\d+(?:\.\d+)?(?:e-?\d+)?)
    |(?P<operator><=|>=|[-+*/<>=(),]))""", re.VERBOSE)
CONDITION = re.compile(r"(?P<key>.+?)\s*(?P<how>\^=|!=|<=|>=|=|<|>)\s*(?P<value>.*)")
ARITHMETIC = {"+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv}
COMPARISONS = {"=": operator.eq, "!=": operator.ne, "<": operator.lt, "<=": operator.le, ">": operator.gt,
               ">=": operator.ge}
FUNCTIONS = {"min(": min, "max(": max, "sum(": sum, "count(": len}


def number(value):
    """A value, or the text of a number, as float; None if it is no number."""
    if isinstance(value, bool) or value is None:
        return None
    try:
        return float(value)
    except (TypeError, ValueError):
        return None


class Expression:
    """An expression, evaluated while it is read; `names` are known from earlier in its file."""

    def __init__(self, text, names):
        self.names, self.tokens, end = names, [], 0
        while end < len(text.rstrip()):
            match = TOKEN.match(text, end)
            if not match:
                raise ValueError(f"cannot read '{text[end:]}'")
            self.tokens.append((match.lastgroup, match[match.lastgroup]))
            end = match.end()
        self.value = self._compared()
        if self.tokens:
            raise ValueError(f"'{self.tokens[0][1]}' is left over in '{text}'")

    def _next(self, *texts):
        found = self.tokens and self.tokens[0][0] == "operator" and self.tokens[0][1] in texts
        return self.tokens.pop(0)[1] if found else None

    def _compared(self):
        left = self._sum()
        how = self._next(*COMPARISONS)
        return COMPARISONS[how](single(left), single(self._sum())) if how else left

    def _sum(self):
        return self._chain(self._product, "+", "-")

    def _product(self):
        return self._chain(self._atom, "*", "/")

    def _chain(self, part, *operators):
        value = part()
        while how := self._next(*operators):
            value = each(ARITHMETIC[how], value, part())
        return value

    def _atom(self):
        if not self.tokens:
            raise ValueError("something is missing at the end")
        kind, text = self.tokens.pop(0)
        if kind == "number":
            return float(text)
        if kind == "place":
            return place(text, self.names)
        if kind == "function":
            values = self._arguments()
            if not values and text != "count(":
                raise ValueError(f"{text}…) of no value")
            return FUNCTIONS[text](values if text == "count(" else [single(value) for value in values])
        if text != "(":
            raise ValueError(f"'{text}' where a value should be")
        value = self._compared()
        if not self._next(")"):
            raise ValueError("a ) is missing")
        return value

    def _arguments(self):
        values = []
        while True:
            value = self._sum()
            values += value if isinstance(value, list) else [value]
            if not self._next(","):
                break
        if not self._next(")"):
            raise ValueError("a ) is missing")
        return values


def each(action, left, right):
    """Applies an action to numbers, or to every entry of lists of equal length."""
    if isinstance(left, list) and isinstance(right, list) and len(left) > 1 and len(left) == len(right):
        return [action(single(a), single(b)) for a, b in zip(left, right)]
    if isinstance(left, list) and len(left) > 1:
        return [action(single(a), single(right)) for a in left]
    return action(single(left), single(right))


def single(value):
    """A value, or a list of one value, as float."""
    if isinstance(value, list):
        if len(value) != 1:
            raise ValueError(f"{len(value)} values where one is expected")
        value = value[0]
    found = number(value)
    if found is None:
        raise ValueError(f"'{value}' is no number")
    return found


def place(text, names):
    """The value at a place."""
    root, *steps = re.findall(r"^(?:results/[\w./-]+#|\w+)|" + STEP, text)
    if root not in names and not root.endswith("#"):
        raise ValueError(f"no name '{root}' is known here")
    value = data(root[:-1]) if root.endswith("#") else names[root]
    for step in steps:
        value = walk(value, step[1:], names)
    return value


def walk(value, step, names):
    """The value after one step of a place."""
    if step.startswith("["):
        conditions = step[1:-1].split(" & ")
        return [entry for entry in value if all(holds(entry, condition, names) for condition in conditions)]
    how, _, key = step.strip("'").partition(":")
    if how in ("least", "most", "sort") and key:
        entries = [entry for entry in value if inside(entry, key) is not None]
        ordered = sorted(entries, key=lambda entry: inside(entry, key))
        if not ordered:
            raise ValueError(f"no entry has '{key}'")
        return ordered if how == "sort" else ordered[0 if how == "least" else -1]
    key = step.strip("'")
    if isinstance(value, list):
        return value[int(key)] if key.isdigit() else [entry[key] for entry in value if key in entry]
    if key not in value:
        raise ValueError(f"there is no '{key}'")
    return value[key]


def inside(entry, key):
    """The value in an object at key/key, as a number if it is one; None if there is none."""
    for part in [key] if key in entry else key.split("/"):
        entry = entry.get(part) if isinstance(entry, dict) else None
    found = number(entry)
    return entry if found is None else found


def holds(entry, condition, names):
    """Whether an entry of a list meets a condition."""
    parts = CONDITION.fullmatch(condition.strip())
    if not parts:
        raise ValueError(f"'{condition}' is no condition")
    have, want = inside(entry, parts["key"]), parts["value"]
    if want.split("/")[0] in names:
        want = single(place(want, names))
    if parts["how"] == "^=":
        return str(have).startswith(want)
    if have is None or (isinstance(have, str) and number(want) is not None):
        return parts["how"] == "!="
    return COMPARISONS[parts["how"]](have, number(want) if isinstance(have, float) else want)


def written(value, how):
    """A value as text: '16 641', '−0.6', '0.33'."""
    if how == "name":
        found = value[0] if isinstance(value, list) and value else value
        return str(found)
    text = format(single(value), how)
    if "e" in text:
        text = format(float(text), ".0f")
    return text.replace(",", " ").replace("-", "−")


# The READMEs ----------------------------------------------------------------------------------------------

def rewritten(path):
    """(the file's text with the right numbers, list of errors 'file:line: …')."""
    name, names, lines, wrong = path.relative_to(ROOT), {}, [], []
    for at, line in enumerate(path.read_text(encoding="utf-8").split("\n"), 1):
        done, end = "", 0
        for marker in MARKER.finditer(line):
            try:
                text, old = stated(marker, line, names)
            except (ValueError, KeyError, TypeError, IndexError, ZeroDivisionError) as error:
                text = old = ""
                wrong.append(f"{name}:{at}: {marker['body']}: {error}")
            if text != old:
                wrong.append(f"{name}:{at}: says {old or 'nothing'}, should be {text} ({marker['body']})")
            begin = marker.end() + (line[marker.end():marker.end() + 1] == "`" and bool(text))
            done, end = done + line[end:begin] + text, begin + len(old)
        lines.append(done + line[end:])
    return "\n".join(lines), wrong


def stated(marker, line, names):
    """(right text, text behind the marker); both empty if the marker has no text or cannot be checked."""
    body = marker["body"]
    if "|" in body or "--" in body:
        raise ValueError("| ends a table's cell, and -- a comment")
    if marker["kind"] == ":":
        name, _, expression = body.partition(" = ")
        names[name] = Expression(expression, names).value
        return "", ""
    if body.startswith("constant: "):
        if not (ROOT / body.split(": ")[1]).is_file():
            raise ValueError("there is no such file")
        return "", ""
    if body.startswith("measured: "):
        if not MEASURED.match(body):
            raise ValueError("should be 'measured: command, yyyy-mm-dd'")
        return "", ""
    if body.startswith("holds: "):
        if Expression(body.removeprefix("holds: "), names).value is not True:
            raise ValueError("does not hold")
        return "", ""
    expression, _, how = body.rpartition(" as ")
    value = Expression(expression, names).value
    behind = line[marker.end():].removeprefix("`")
    old = (NAME_TEXT if how == "name" else NUMBER_TEXT).match(behind)
    return written(value, how), old[0] if old else ""
