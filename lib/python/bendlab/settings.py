"""Classes of settings, made from the program's tables of settings, so that no setting is listed twice."""
import difflib
import json
import keyword

from bendlab import _core, own


def class_name(name):
    """"discrete_shells" → "DiscreteShells"; a Python keyword gets an underscore."""
    camel = "".join(word.capitalize() for word in name.split("_"))
    return camel + "_" * keyword.iskeyword(camel)


def plain(value):
    """Converts settings, and numbers and arrays of NumPy, for json.dumps()."""
    if isinstance(value, Settings):
        return value._config()
    if isinstance(value, (range, set)):
        return list(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"a setting is a number, a text or a list of these, not {value!r}")


def _documentation(field):
    unit = f" ({field['unit']})" if field["unit"] else ""
    default = "absent" if field["default"] is None else json.dumps(field["default"], ensure_ascii=False)
    return f"{field['name']}{unit}: {field['expected']}; default {default}. {field['meaning']}."


class Settings:
    """Settings with their defaults. A setting that does not exist, or a value that it cannot have, raises
    ConfigError with the setting's pointer and the allowed values."""

    _tables = ()  # the class's own settings, then those that its whole family has
    _inner = {}  # {name: class} of members that have settings of their own

    def __init__(self, **values):
        object.__setattr__(self, "_given", {})
        for name, cls in self._inner.items():
            setattr(self, name, values.pop(name, None) or cls())
        for name, value in values.items():
            setattr(self, name, value)

    def __setattr__(self, name, value):
        if name.startswith("_") or isinstance(getattr(type(self), name, None), Part):
            object.__setattr__(self, name, value)
            return
        table = next((table for table in self._tables if name in table.defaults), None)
        if table is None:
            raise _unknown(type(self), name)
        try:
            text = json.dumps(value, default=plain, allow_nan=False)
        except ValueError:
            raise _error(type(self), name, f"{value!r} has a number that is not finite") from None
        checked = table.read(name, text)
        self._given[name] = tuple(checked) if isinstance(checked, list) else checked

    def _get(self, name):
        if name in self._given:
            return self._given[name]
        default = next(table.defaults[name] for table in self._tables if name in table.defaults)
        return tuple(default) if isinstance(default, list) else default

    def _stated(self, table):
        """The settings of `table` that were given, for JSON."""
        return {table.key(name): value for name, value in self._given.items() if name in table.defaults}

    def _inner_config(self):
        """The members that have settings of their own, for JSON, without those that have only defaults."""
        configs = {name: getattr(self, name)._config() for name in self._inner}
        return {name: config for name, config in configs.items() if config}

    def _config(self):
        """The settings that were given, for JSON."""
        return {**self._given, **self._inner_config()}

    def _arguments(self):
        return {**self._given, **{name: getattr(self, name) for name in self._inner_config()}}

    def __eq__(self, other):
        if type(self) is not type(other):
            return False
        names = {name for table in self._tables for name in table.defaults}
        return all(self._get(name) == other._get(name) for name in names) and self._parts() == other._parts()

    def _parts(self):
        """Members that have settings of their own, for comparisons."""
        cls = type(self)
        return [getattr(self, name) for name in dir(cls) if isinstance(getattr(cls, name), Part)]

    __hash__ = None

    def __repr__(self):
        return f"{type(self).__name__}({', '.join(f'{k}={v!r}' for k, v in self._arguments().items())})"


def _unknown(cls, name):
    known = [*(name for table in cls._tables for name in table.defaults),
             *(name for name in dir(cls) if isinstance(getattr(cls, name), Part))]
    near = difflib.get_close_matches(name, known, 1)
    return _error(cls, name, "there is no such setting; " +
                  (f"did you mean {near[0]}?" if near else f"there are {', '.join(known)}"))


def _error(cls, name, text):
    """ConfigError about a setting of a class."""
    pointer = f"{cls._tables[0].pointer}/{name}"
    error = _core.ConfigError(f"{cls.__name__}: {pointer}: {text}")
    error.problems = [(pointer, text)]
    return error


class Part:
    """A member of a scene that has settings of its own. `convert` makes it from an assigned value."""

    def __init__(self, convert, meaning):
        self._convert, self.__doc__ = convert, meaning

    def __set_name__(self, owner, name):
        self._name = "_part_" + name

    def __get__(self, scene, owner=None):
        return self if scene is None else getattr(scene, self._name)

    def __set__(self, scene, value):
        object.__setattr__(scene, self._name, self._convert(value))


class _Table:
    """A table of the program's settings, with the defaults by name. A setting whose name is in `taken` gets
    the table's name as a prefix: if a model has its own setting k, the k of /bending is called bending_k."""

    def __init__(self, table, taken=()):
        self.name, self.pointer, self.meaning, self._program = table.name, table.pointer, table.meaning, table
        self.fields = table.fields()
        self._keys = {}
        for field in self.fields:
            if field["name"] in taken:
                self._keys[f"{self.name}_{field['name']}"] = field["name"]
                field["name"] = f"{self.name}_{field['name']}"
        self.defaults = {field["name"]: field["default"] for field in self.fields}

    def key(self, name):
        """The name in a config."""
        return self._keys.get(name, name)

    def read(self, name, text):
        return self._program.read(self.key(name), text)

    def beside(self, table):
        """This table, for a class that also has the settings of `table`."""
        taken = set(self.defaults) & set(table.defaults)
        return _Table(self._program, taken) if taken else self


def _property(field):
    name = field["name"]
    return property(lambda self: self._get(name), lambda self, value: setattr(self, name, value),
                    doc=_documentation(field))


def _class_documentation(tables, first):
    rows = [_documentation(field) for table in tables for field in table.fields]
    return "\n\n".join([*([first.strip()] if first else []), *rows])


def make_class(name, tables, base=Settings):
    """A class that has the settings of these tables. Its documentation lists the settings."""
    members = {field["name"]: _property(field) for table in reversed(tables) for field in table.fields}
    text = _class_documentation(tables, tables[0].meaning[:1].upper() + tables[0].meaning[1:] + ".")
    return type(name, (base,), {"_tables": tuple(tables), "__doc__": text, "__module__": "bendlab",
                                "_name": tables[0].name, **members})


def instance_of(wanted, what):
    """Returns a converter for values that are assigned to a part. The converter accepts objects of the class
    `wanted`, and raises TypeError for all other values; `what` says what is expected."""
    def convert(value):
        if not isinstance(value, wanted):
            raise TypeError(f"expected {what}, got {value!r}")
        return value
    return convert


PARTS = {table.pointer: _Table(table) for table in _core.parts()}
SCENE, BENDING, SOLVER = (PARTS[pointer] for pointer in ("", "/bending", "/solver"))
INNER = {}  # the classes of parts below other parts, by name; parts with the same settings share a class


def add_inner(cls, pointer):
    """Gives the class of the part at `pointer` a member for each part below it. Returns the class."""
    cls._inner = {}
    for below, table in PARTS.items():
        parent, _, last = below.rpartition("/")
        if parent != pointer or not below:
            continue
        name = "Map" if last.endswith("_map") else class_name(last)
        if name not in INNER:
            INNER[name] = add_inner(make_class(name, [table]), below)
        else:  # the class serves several parts, so their one meaning would be wrong
            INNER[name].__doc__ = _class_documentation([table], f"Settings of {name}.")
        cls._inner[last] = INNER[name]
        part = Part(instance_of(INNER[name], f"{name}(…)"), table.meaning)
        part.__set_name__(cls, last)
        setattr(cls, last, part)
    return cls


_CURRENT = {}  # (family, name) → the class of that name


def base_of(cls):
    return next(base for base in (Model, Effect) if issubclass(cls, base))


def _require_current(member):
    """Raises TypeError if the class of `member` was defined again. The program knows classes by their names,
    so the new class has replaced the old class."""
    current = _CURRENT.get((base_of(type(member)), member._name), type(member))
    if current is not type(member):
        raise TypeError(f"{type(member).__name__} was defined again after this scene was made: make the "
                        "scene anew, with the new class, or give the classes different names")


def _read_own(cls, register, tables, shared):
    """Registers a class that is written in Python, and makes properties of its settings."""
    taken = [row["name"] for row in own.setting_rows(cls) for table in shared
             if row["name"] in table.defaults]
    if taken:
        raise TypeError(f"{cls.__name__}: all classes of this kind already have a setting {taken[0]}: choose "
                        "another name")
    cls._rows = {**getattr(cls, "_rows", {}), **{row["name"]: row for row in own.setting_rows(cls)}}
    register(cls, own.about(cls), list(cls._rows.values()))
    cls._name = own.snake_name(cls.__name__)
    _CURRENT[base_of(cls), cls._name] = cls
    table = next(_Table(listed) for listed in tables() if listed.name == cls._name)
    cls._tables = (table, *(other.beside(table) for other in shared))
    for own_or_shared in cls._tables:
        for field in own_or_shared.fields:
            setattr(cls, field["name"], _property(field))
    cls.__doc__ = _class_documentation(cls._tables, cls.__doc__)


class Model(Settings):
    """A bending model, with its own settings and the settings that all models share.

    Your own model is a subclass, which Scene and run() know by its name in snake case:

        class Opposite(bl.Model):
            '''the square of the distance across every edge'''
            factor = bl.Setting(1.0, unit="1/m", meaning="on the change", minimum=0)

            def elements(self, rest):       # once for a mesh: see Rest and Elements
                pairs = rest.hinges[:, 2:]
                d = rest.positions[pairs[:, 1]] - rest.positions[pairs[:, 0]]
                return bl.Elements(pairs, square=(d ** 2).sum(axis=1))

            def constraint(self, x, rest):  # x (n, k, 3) in m: corners of n elements
                d = x[:, 1] - x[:, 0]
                value = (d ** 2).sum(axis=1) - rest.square
                return self.factor * value, self.factor * np.stack([-2 * d, 2 * d], axis=1)

    `constraint` returns C, (n), and its gradient, (n, k, 3); the energy is ½ C² / α.

    Instead of `constraint`, a model may have `energy(self, x, rest)`, which returns U and its gradient; the
    energy of an element is then U / α. `rest` has the arrays that were given to Elements, for these n
    elements. A value must not change if all vertices of its element move by the same vector. An element whose
    value is NaN does not act. When Python reads the class, bendlab compares the gradient with finite
    differences.
    """

    def __init_subclass__(cls, **arguments):
        super().__init_subclass__(**arguments)
        if "_tables" in vars(cls):
            return  # a class of the program
        if not hasattr(cls, "elements") or hasattr(cls, "constraint") == hasattr(cls, "energy"):
            raise TypeError(f"{cls.__name__} needs elements(), and either constraint() or energy()")
        _read_own(cls, _core.register_model, _core.models, [BENDING])
        try:
            own.check_gradient(cls())
        except Exception:
            _core.remove_model(cls._name)
            raise

    def _config(self):
        _require_current(self)
        own = self._stated(self._tables[0])
        return {"model": self._name, **self._stated(self._tables[1]), **self._inner_config(),
                **({self._name: own} if own else {})}


class Method(Settings):
    """A solver method, with its own settings and the settings that all methods share."""

    def _config(self):
        return {"method": self._name, **self._given}


class Effect(Settings):
    """An effect acts on the cloth besides its constraints.

    Your own effect is a subclass, which Scene and run() know by its name in snake case:

        class Trap(bl.Effect):
            '''pulls every vertex to the origin'''
            frequency = bl.Setting(1.0, unit="1/s", meaning="f of x'' = -(2 π f)² x", minimum=0)

            def acceleration(self, x, v, t):        # (V, 3) in m and m/s, t in s
                return -(2 * np.pi * self.frequency) ** 2 * x

    Instead of `acceleration` (m/s²) an effect may have `force` (N). The function is called at the start of
    every substep, and returns (V, 3), or (3,) for all vertices. Set `damps = True` in the class if the effect
    only slows the cloth, and `keeps_momentum = True` if the effect does not change the cloth's linear
    momentum.
    """

    def __init_subclass__(cls, **arguments):
        super().__init_subclass__(**arguments)
        if "_tables" in vars(cls):
            return  # a class of the program
        if hasattr(cls, "acceleration") == hasattr(cls, "force"):
            raise TypeError(f"{cls.__name__} needs either acceleration() or force()")
        _read_own(cls, _core.register_effect, _core.effects, [])

    def _config(self):
        _require_current(self)
        return {"type": self._name, **self._given}


def _family(tables, base, *shared):
    tables = [_Table(table) for table in tables]
    classes = [make_class(class_name(table.name), [table, *(other.beside(table) for other in shared)], base)
               for table in tables]
    return {made.__name__: made for made in classes}


MODELS = _family(_core.models(), Model, BENDING)
METHODS = _family(_core.methods(), Method, SOLVER)
EFFECTS = _family(_core.effects(), Effect)
