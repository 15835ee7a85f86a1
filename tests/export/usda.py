"""A strict reader of the part of USD's text format that exports use. Anything else is a ValueError.

The grammar follows the documentation of OpenUSD's text files, version 1.0: layer metadata, prims with `def`,
properties with types, values, time samples and metadata. A statement ends at the end of its line.
"""
import re

TOKEN = re.compile(r"""(?P<space>[ \t\r\n]+)
  |(?P<text>"(?:[^"\\\n]|\\.)*")
  |(?P<number>[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?![\w.])|[-+]?inf\b|nan\b)
  |(?P<word>[A-Za-z_]\w*(?:[:.][A-Za-z_]\w*)*(?:\[\])?)
  |(?P<mark>[()\[\]{}=:,])""", re.VERBOSE)

# Type: length of the tuple of an entry (0: no tuple), type of its elements, whether they are whole numbers.
TYPES = {
    "bool": (0, float, True),
    "int": (0, float, True),
    "double": (0, float, False),
    "token": (0, str, False),
    "string": (0, str, False),
    "float3": (3, float, False),
    "point3f": (3, float, False),
    "double3": (3, float, False),
    "texCoord2f": (2, float, False)}
LAYER = {"doc": str, "customLayerData": dict, "defaultPrim": str, "metersPerUnit": float, "upAxis": str,
         "framesPerSecond": float, "timeCodesPerSecond": float, "startTimeCode": float, "endTimeCode": float}
INTERPOLATIONS = ("constant", "uniform", "varying", "vertex", "faceVarying")


class _Reader:

    def __init__(self, text):
        self.text, self.tokens, at = text, [], len("#usda 1.0\n")
        if not text.startswith("#usda 1.0\n"):
            raise ValueError("the first line is not '#usda 1.0'")
        fresh = True  # the next token is the first of its line
        while at < len(text):
            match = TOKEN.match(text, at)
            if not match:
                raise ValueError(f"byte {at}: no token begins with {text[at:at + 20]!r}")
            if match.lastgroup == "space":
                fresh = fresh or "\n" in match[0]
            else:
                self.tokens.append((match.lastgroup, match[0], fresh, at))
                fresh = False
            at = match.end()
        self.tokens.append(("end", "", True, at))
        self.next = 0

    def fail(self, expected):
        kind, word, _, at = self.tokens[self.next]
        raise ValueError(f"byte {at}: expected {expected}, got {kind} {word!r}")

    def sees(self, word):
        return self.tokens[self.next][1] == word and self.tokens[self.next][0] != "text"

    def take(self, kind, word=None):
        if self.tokens[self.next][0] != kind or (word is not None and self.tokens[self.next][1] != word):
            self.fail(word or kind)
        self.next += 1
        return self.tokens[self.next - 1][1]

    def new_line(self):
        if not self.tokens[self.next][2]:
            self.fail("a new line")

    def text_value(self):
        return re.sub(r"\\(.)", r"\1", self.take("text")[1:-1])

    def value(self):
        if self.tokens[self.next][0] == "text":
            return self.text_value()
        if self.tokens[self.next][0] == "number":
            return float(self.take("number"))
        for first, last, sequence in (("(", ")", tuple), ("[", "]", list)):
            if self.sees(first):
                self.take("mark", first)
                entries = []
                while not self.sees(last):
                    entries.append(self.value())
                    if not self.sees(last):
                        self.take("mark", ",")
                self.take("mark", last)
                return sequence(entries)
        return self.fail("a value")

    def dictionary(self):
        self.take("mark", "{")
        entries = {}
        while not self.sees("}"):
            self.new_line()
            kind, name = self.take("word"), self.take("word")
            self.take("mark", "=")
            if name in entries:
                self.fail(f"a name other than '{name}', which is already there")
            entries[name] = self.dictionary() if kind == "dictionary" else checked(self.value(), kind)
        self.take("mark", "}")
        return entries

    def metadata(self, known):
        self.take("mark", "(")
        values = {}
        while not self.sees(")"):
            self.new_line()
            name = self.take("word")
            self.take("mark", "=")
            values[name] = self.dictionary() if self.sees("{") else self.value()
            if name not in known or not isinstance(values[name], known[name]):
                raise ValueError(f"metadata '{name}' is unknown, or does not take {values[name]!r}")
        self.take("mark", ")")
        return values

    def samples(self, kind):
        self.take("mark", "{")
        values = {}
        while not self.sees("}"):
            self.new_line()
            time = float(self.take("number"))
            self.take("mark", ":")
            if values and time <= max(values):
                raise ValueError(f"the time {time} does not come after {max(values)}")
            values[time] = checked(self.value(), kind)
            self.take("mark", ",")
        self.take("mark", "}")
        return values

    def property(self):
        self.new_line()
        uniform = self.sees("uniform")
        if uniform:
            self.take("word")
        kind, name = self.take("word"), self.take("word")
        self.take("mark", "=")
        sampled = name.endswith(".timeSamples")
        if uniform and sampled:
            raise ValueError(f"'{name}' is uniform and has samples")
        value = self.samples(kind) if sampled else checked(self.value(), kind)
        metadata = self.metadata({"interpolation": str}) if self.sees("(") else {}
        if metadata.get("interpolation", "constant") not in INTERPOLATIONS:
            raise ValueError(f"there is no interpolation '{metadata['interpolation']}'")
        return name, {"type": kind, "uniform": uniform, "value": value, **metadata}

    def prim(self):
        self.new_line()
        self.take("word", "def")
        prim = {"type": self.take("word"), "name": self.text_value(), "properties": {}, "children": {}}
        if not re.fullmatch(r"[A-Za-z_]\w*", prim["name"], re.ASCII):
            raise ValueError(f"'{prim['name']}' is not a valid name of a prim")
        self.take("mark", "{")
        while not self.sees("}"):
            if self.sees("def"):
                child = self.prim()
                if child["name"] in prim["children"]:
                    raise ValueError(f"there are two prims with the name '{child['name']}'")
                prim["children"][child["name"]] = child
            else:
                name, entry = self.property()
                if name in prim["properties"]:
                    raise ValueError(f"'{prim['name']}' has two properties with the name '{name}'")
                prim["properties"][name] = entry
        self.take("mark", "}")
        return prim


def checked(value, kind):
    """Returns the value, or raises a ValueError if it is not of this type."""
    base, is_list = (kind[:-2], True) if kind.endswith("[]") else (kind, False)
    if base not in TYPES:
        raise ValueError(f"there is no type '{kind}'")
    count, entry, whole = TYPES[base]
    if is_list != isinstance(value, list):
        raise ValueError(f"{value!r:.60} is not of the type {kind}")
    for item in value if is_list else [value]:
        numbers = item if count else (item,)
        if not isinstance(numbers, tuple) or len(numbers) != (count or 1) or any(
                not isinstance(number, entry) or (whole and number != int(number)) for number in numbers):
            raise ValueError(f"{item!r:.60} is not of the type {base}")
    return value


def read_stage(path):
    """Returns (layer metadata, prims by name) of a file. A prim has type, name, properties and children."""
    reader = _Reader(path.read_text(encoding="utf-8"))
    metadata, prims = reader.metadata(LAYER) if reader.sees("(") else {}, {}
    while not reader.sees(""):
        prim = reader.prim()
        prims[prim["name"]] = prim
    return metadata, prims
