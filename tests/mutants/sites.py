"""Finds the possible changes (mutants) of a source file: reads its expressions and statements with libclang.

A mutant is a dict: operator, line, what (old and new text, for the reader), function, edits. An edit is
[begin, end, text]: the text replaces these bytes of the file. In the text, ON stands for the condition that
the mutant is switched on.
"""
import glob
import re

import clang.cindex as clang
from clang.cindex import CursorKind as K, TypeKind as T

ON = "@mutant_is_on@"

SWAPS = {"+": "-", "-": "+", "*": "/", "/": "*",
         "<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&"}
ASSIGNING_SWAPS = {"+=": "-=", "-=": "+=", "*=": "/=", "/=": "*="}
EXTREMES = {"min": "max", "max": "min", "minCoeff": "maxCoeff", "maxCoeff": "minCoeff",
            "min_element": "max_element", "max_element": "min_element"}
NAMES = {"+": "arithmetic", "-": "arithmetic", "*": "arithmetic", "/": "arithmetic", "&&": "and-or",
         "||": "and-or", "==": "comparison", "!=": "comparison"}

FLOATING = {T.FLOAT, T.DOUBLE, T.LONGDOUBLE}
INTEGRAL = {T.BOOL, T.CHAR_U, T.UCHAR, T.USHORT, T.UINT, T.ULONG,
    T.ULONGLONG, T.CHAR_S, T.SCHAR, T.SHORT, T.INT, T.LONG, T.LONGLONG}
DEPENDENT = {T.DEPENDENT, T.UNEXPOSED, T.TYPEDEF, T.ELABORATED}
VALUES = FLOATING | INTEGRAL | DEPENDENT | {T.VECTOR, T.EXTVECTOR}

FUNCTIONS = {K.FUNCTION_DECL, K.CXX_METHOD, K.CONSTRUCTOR, K.DESTRUCTOR, K.FUNCTION_TEMPLATE,
             K.CONVERSION_FUNCTION}
# Expressions that must be known at compile time, and declarations that do not run.
CONSTANT = {K.STATIC_ASSERT, K.ENUM_DECL, K.TYPE_ALIAS_DECL, K.TYPEDEF_DECL, K.PARM_DECL, K.CXX_UNARY_EXPR,
            K.TEMPLATE_NON_TYPE_PARAMETER, K.TEMPLATE_TYPE_PARAMETER, K.FIELD_DECL}
WRAPPERS = {K.UNEXPOSED_EXPR, K.PAREN_EXPR}


def load_library():
    """Loads libclang. If Debian's libclang 15 to 19 is installed, takes this library."""
    if clang.Config.loaded:
        return
    libraries = sorted(glob.glob("/usr/lib/x86_64-linux-gnu/libclang-1[5-9].so.1")
                       or glob.glob("/usr/lib/llvm-*/lib/libclang.so.1"))
    if libraries:
        clang.Config.set_library_file(libraries[-1])


class Finder:
    """The possible changes of one file. libclang gives the extent of a cursor in bytes."""

    def __init__(self, path, flags):
        load_library()
        self.path = str(path)
        self.source = path.read_bytes()
        unit = clang.Index.create().parse(self.path, args=flags,
                                          options=clang.TranslationUnit.PARSE_DETAILED_PROCESSING_RECORD)
        errors = [str(note) for note in unit.diagnostics if note.severity >= clang.Diagnostic.Error]
        if errors:
            raise SystemExit(f"libclang cannot read {path} (versions 15 and later read C++20): {errors[0]}")
        self.mutants = []
        here = [cursor for cursor in unit.cursor.get_children() if self.is_here(cursor)]
        self.macros = [self.extent(cursor) for cursor in here if cursor.kind == K.MACRO_INSTANTIATION
                       and not cursor.spelling.endswith("_INLINE")]
        for cursor in here:
            if cursor.kind not in (K.MACRO_INSTANTIATION, K.MACRO_DEFINITION, K.INCLUSION_DIRECTIVE):
                self.visit(cursor, None, None)

    def is_here(self, cursor):
        file = cursor.location.file
        return file is not None and file.name == self.path

    @staticmethod
    def extent(cursor):
        return cursor.extent.start.offset, cursor.extent.end.offset

    def text(self, begin, end):
        return self.source[begin:end].decode()

    def line(self, offset):
        return self.source.count(b"\n", 0, offset) + 1

    def tokens(self, cursor):
        return [token.spelling for token in cursor.get_tokens()]

    # ---- the walk

    def visit(self, cursor, parent, function):
        try:
            kind = cursor.kind
        except ValueError:  # a concept, for which the Python package has no name
            return
        if kind in CONSTANT or (kind in FUNCTIONS and self.is_constexpr(cursor)):
            return
        if kind == K.VAR_DECL and self.is_constexpr(cursor):
            self.constant_variable(cursor, function)
            return
        if kind == K.VAR_DECL and function is None:
            return
        if kind in FUNCTIONS:
            function = cursor.spelling
            self.early_return(cursor, function)
        if function is not None:
            self.changes(cursor, parent, function)
        children = list(cursor.get_children())
        if kind == K.CASE_STMT and children:
            children = children[1:]
        if kind == K.IF_STMT and re.match(r"if\s+constexpr", self.text(*self.extent(cursor))):
            children = children[1:]
        for child in children:
            self.visit(child, cursor, function)

    def is_constexpr(self, cursor):
        begin, _ = self.extent(cursor)
        head = self.text(begin, cursor.location.offset)
        return re.search(r"\b(constexpr|consteval)\b", head) is not None

    def add(self, operator, function, begin, end, new, edits):
        if any(first < end and begin < last for first, last in self.macros):
            return
        old = " ".join(self.text(begin, end).split())
        self.mutants.append({"operator": operator, "function": function or "", "line": self.line(begin),
                             "what": f"{old[:90]}  →  {new[:90]}", "edits": edits})

    def choice(self, operator, function, cursor, new):
        """Replaces the expression by the text `new` where the mutant is on."""
        begin, end = self.extent(cursor)
        self.add(operator, function, begin, end, " ".join(new.split()),
                 [[begin, end, f"({ON} ? ({new}) : ({self.text(begin, end)}))"]])

    # ---- the operators

    def changes(self, cursor, parent, function):
        kind = cursor.kind
        if kind == K.BINARY_OPERATOR:
            self.binary(cursor, function)
        elif kind == K.COMPOUND_ASSIGNMENT_OPERATOR:
            self.assigning(cursor, function)
        elif kind == K.UNARY_OPERATOR:
            self.unary(cursor, function)
        elif kind in (K.INTEGER_LITERAL, K.FLOATING_LITERAL):
            self.literal(cursor, parent, function)
        elif kind == K.ARRAY_SUBSCRIPT_EXPR:
            self.index(cursor, list(cursor.get_children()), function)
        elif kind == K.CALL_EXPR:
            self.call(cursor, function)
        elif kind in (K.IF_STMT, K.WHILE_STMT, K.CONDITIONAL_OPERATOR):
            self.condition(cursor, function)
        elif kind == K.RETURN_STMT:
            self.returned(cursor, function)
        if kind == K.COMPOUND_STMT:
            for child in cursor.get_children():
                self.removal(child, function)
        elif kind in (K.IF_STMT, K.FOR_STMT, K.CXX_FOR_RANGE_STMT, K.WHILE_STMT):
            for child in list(cursor.get_children())[1:]:
                is_body = kind == K.IF_STMT or child == list(cursor.get_children())[-1]
                if is_body and child.kind != K.COMPOUND_STMT:
                    self.removal(child, function)

    def between(self, left, right):
        """The operator between two operands, its position, and the end of the left operand. The operator is
        None if parentheses stand between the operands."""
        begin, end = self.extent(left)[1], self.extent(right)[0]
        match = re.fullmatch(r"\s*([-+*/<>=!&|]+)\s*", self.text(begin, end))
        return (match[1], begin + len(match[0][:match.start(1)].encode()), begin) if match else (None, 0, 0)

    def kind_of(self, cursor):
        return cursor.type.get_canonical().kind

    def binary(self, cursor, function):
        children = list(cursor.get_children())
        if len(children) != 2:
            return
        left, right = children
        sign, at, _ = self.between(left, right)
        if sign not in SWAPS or self.kind_of(cursor) not in VALUES:
            return
        if sign in "+-" and self.kind_of(cursor) in DEPENDENT:
            self.flipped(cursor, right, sign, function)
            return
        begin, end = self.extent(cursor)
        new = self.text(begin, at) + SWAPS[sign] + self.text(at + len(sign), end)
        self.choice(NAMES.get(sign, "boundary"), function, cursor, new)

    def flipped(self, cursor, right, sign, function):
        begin, end = self.extent(right)
        if self.text(begin, end).lstrip().startswith(('"', "'")):
            return
        whole = self.extent(cursor)
        new = self.text(whole[0], begin) + "-(" + self.text(begin, whole[1]) + ")"
        self.add("arithmetic", function, *whole, " ".join(new.split()),
                 [[begin, end, f"::bendlab_flipped({ON}, {self.text(begin, end)})"]])

    def assigning(self, cursor, function):
        children = list(cursor.get_children())
        if len(children) != 2 or self.kind_of(cursor) not in VALUES:
            return
        sign, at, _ = self.between(*children)
        if sign in ASSIGNING_SWAPS:
            begin, end = self.extent(cursor)
            self.choice("arithmetic", function, cursor,
                        self.text(begin, at) + ASSIGNING_SWAPS[sign] + self.text(at + len(sign), end))

    def unary(self, cursor, function):
        begin, end = self.extent(cursor)
        text = self.text(begin, end)
        if text.startswith("-") and not text.startswith("--") and self.kind_of(cursor) in VALUES:
            self.choice("sign", function, cursor, text[1:])
        elif text.startswith("!") and not text.startswith("!=") and self.kind_of(cursor) in VALUES:
            self.choice("condition", function, cursor, f"!!({text[1:]})")

    def literal(self, cursor, parent, function):
        if parent is not None and parent.kind in (K.ARRAY_SUBSCRIPT_EXPR, K.DECL_REF_EXPR, K.MEMBER_REF_EXPR):
            return
        text = self.text(*self.extent(cursor))
        if not re.fullmatch(r"[0-9][0-9.e+-]*[uUfFlL]*", text):
            return
        value = float(re.sub(r"[uUfFlL]+$", "", text))
        suffix = re.search(r"[uUfFlL]*$", text)[0]
        dot = ".0" if cursor.kind == K.FLOATING_LITERAL else ""
        new = "1" + dot + suffix if value == 0 else "0" + dot + suffix if value == 1 else f"2 * {text}"
        self.choice("constant", function, cursor, new)

    def constant_variable(self, cursor, function):
        """Turns `constexpr double limit = 3` into a variable, so that it can have two values."""
        children = list(cursor.get_children())
        if not children or self.kind_of(cursor) not in FLOATING | INTEGRAL:
            return
        begin, end = self.extent(children[-1])
        start = self.extent(cursor)[0]
        head = re.search(r"\bconstexpr\b", self.text(start, cursor.location.offset))
        value = self.text(begin, end)
        if not head or children[-1].kind not in (K.INTEGER_LITERAL, K.FLOATING_LITERAL):
            return
        at = start + len(self.text(start, cursor.location.offset)[:head.start()].encode())
        new = "1" if float(value) == 0 else f"2 * {value}"
        self.add("constant", function or cursor.spelling, begin, end, new,
                 [[at, at + len("constexpr"), "const"], [begin, end, f"({ON} ? {new} : {value})"]])

    def index(self, cursor, children, function):
        if len(children) != 2 or self.kind_of(children[1]) not in INTEGRAL | DEPENDENT:
            return
        begin, end = self.extent(children[1])
        text = self.text(begin, end)
        if '"' in text:
            return
        whole = self.extent(cursor)
        new = self.text(whole[0], end) + " + 1" + self.text(end, whole[1])
        self.add("index", function, *whole, " ".join(new.split()),
                 [[begin, end, f"({text}) + ({ON} ? 1 : 0)"]])

    def call(self, cursor, function):
        begin, end = self.extent(cursor)
        text, name = self.text(begin, end), cursor.spelling
        arguments = list(cursor.get_arguments())
        eigen = "Eigen::" in cursor.type.get_canonical().spelling
        if name in ("operator+", "operator-") and len(arguments) == 2 and eigen:
            sign, _, _ = self.between(*arguments)
            if sign in ("+", "-"):
                self.flipped(cursor, arguments[1], sign, function)
            return
        if name in ("operator+=", "operator-=") and len(arguments) == 2 and eigen:
            sign, at, _ = self.between(*arguments)
            if sign in ASSIGNING_SWAPS:
                self.choice("arithmetic", function, cursor,
                            self.text(begin, at) + ASSIGNING_SWAPS[sign] + self.text(at + len(sign), end))
            return
        if name == "operator[]" and len(arguments) == 2:
            self.index(cursor, arguments, function)
            return
        extreme = re.match(r"std::(?:ranges::)?(min|max|min_element|max_element)\b(?=[<(])", text)
        if extreme is None:
            extreme = re.match(r"(?s).*\.(minCoeff|maxCoeff)(?=\(\)$)", text)
        if extreme:
            at, last = extreme.span(1)
            self.choice("min-max", function, cursor, text[:at] + EXTREMES[extreme[1]] + text[last:])

    def condition(self, cursor, function):
        children = list(cursor.get_children())
        if not children:
            return
        begin, end = self.extent(children[0])
        before = self.text(self.extent(cursor)[0], begin)
        if cursor.kind == K.CONDITIONAL_OPERATOR:
            if self.kind_of(children[0]) != T.BOOL or before:
                return
        elif not re.fullmatch(r"(if|while)\s*\(\s*", before) or not children[0].kind.is_expression():
            return
        elif self.kind_of(children[0]) not in VALUES | {T.POINTER}:
            return
        text = self.text(begin, end)
        self.add("condition", function, begin, end, "not (" + " ".join(text.split()) + ")",
                 [[begin, end, f"({ON} != static_cast<bool>({text}))"]])

    def returned(self, cursor, function):
        children = list(cursor.get_children())
        if len(children) == 1 and self.kind_of(children[0]) == T.BOOL:
            begin, end = self.extent(children[0])
            text = self.text(begin, end)
            self.add("condition", function, begin, end, "not (" + " ".join(text.split()) + ")",
                     [[begin, end, f"({ON} != static_cast<bool>({text}))"]])

    def core(self, cursor):
        while cursor.kind in WRAPPERS:
            children = list(cursor.get_children())
            if len(children) != 1:
                break
            cursor = children[0]
        return cursor

    def removal(self, cursor, function):
        core = self.core(cursor)
        begin, end = self.extent(cursor)
        text = self.text(begin, end)
        bare = core.kind == K.RETURN_STMT and not list(core.get_children())
        if core.kind == K.BINARY_OPERATOR:
            children = list(core.get_children())
            if len(children) != 2 or self.between(*children)[0] != "=":
                return
        elif core.kind not in (K.CALL_EXPR, K.COMPOUND_ASSIGNMENT_OPERATOR, K.CXX_THROW_EXPR, K.CONTINUE_STMT,
                               K.UNARY_OPERATOR) and not bare:
            return
        stop = self.source.find(b";", end)
        if stop < 0 or self.source[end:stop].strip():
            return
        self.add("removal", function, begin, end, "nothing",
                 [[begin, stop + 1, f"{{ if (!{ON}) {{ {text}; }} }}"]])

    def early_return(self, cursor, function):
        if cursor.kind in (K.CONSTRUCTOR, K.DESTRUCTOR):
            return
        bodies = [child for child in cursor.get_children() if child.kind == K.COMPOUND_STMT]
        if not bodies:
            return
        kind = cursor.result_type.get_canonical().kind
        if kind in (T.LVALUEREFERENCE, T.RVALUEREFERENCE, T.AUTO):
            return
        statements = list(bodies[-1].get_children())
        for statement in statements[1:]:
            begin, end = self.extent(statement)
            value = "" if kind == T.VOID else " {}"
            self.add("early return", function, begin, end, f"return{value}; before it",
                     [[begin, begin, f"if ({ON}) return{value}; "]])
