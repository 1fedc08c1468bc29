"""Single changes to C++ sources that a test should notice."""
import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Mutation:
    """`old`, at one place of one file, becomes `new`."""
    path: str
    offset: int
    old: str
    new: str
    kind: str

    def applied_to(self, text):
        assert text[self.offset:self.offset + len(self.old)] == self.old
        return text[:self.offset] + self.new + text[self.offset + len(self.old):]


# Comments, literals, preprocessor lines, and what the compiler or nobody checks.
IGNORED = re.compile(
    r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\''
    r'|^[ ]*#(?:\\\n|[^\n])*'
    r'|\bstatic_assert\b[^;]*;|\bassert\([^;]*;|\bSIMDBEZIER_ASSERT\b[^;]*;'
    r'|\btemplate <[^{;]*?>\n|\busing [^;]*;|\bextern template [^;]*;',
    re.S | re.M)


def blanked(text):
    """The text with everything that is not to be changed as spaces, at equal offsets."""
    return IGNORED.sub(lambda match: re.sub(r'[^\n]', ' ', match[0]), text)


def changed_integer(match):
    value = int(match[0])
    return [str(value + 1)] + ([str(value - 1)] if value > 0 else [])


def changed_decimal(match):
    value = float(match[0])
    return [repr(value * 1.25) if value else '1.0']


# What stands before the length of an array that is declared: one element more changes nothing.
DECLARED = re.compile(r'(?:^|[;({,]) *(?:(?:inline|static|constexpr|const|mutable|thread_local'
                      r'|alignas\([^)]*\)) )*(?!(?:return|case|delete|throw) )'
                      r'[A-Za-z_][\w:<>]* [*&]?\w+$')


def next_element(match):
    line = match.string[match.string.rfind('\n', 0, match.start()) + 1:match.start()]
    return [] if DECLARED.search(line) else [f'[({match[1]}) + 1]']


def constant(text):
    return lambda match: [text]


# (kind, pattern, replacements of the whole match). Blanks around operators tell them from
# templates and references: the sources are formatted.
RULES = [
    ('sign', re.compile(r'(?<=[\w)\]] )\+(?= \S)'), constant('-')),
    ('sign', re.compile(r'(?<=[\w)\]] )-(?= \S)'), constant('+')),
    ('sign', re.compile(r'(?<= )\+=(?= )'), constant('-=')),
    ('sign', re.compile(r'(?<= )-=(?= )'), constant('+=')),
    ('sign', re.compile(r'(?:(?<=[(,=] )|(?<=return )|(?<=\())-(?=[A-Za-z_(])'), constant('')),
    ('sign', re.compile(r'\bmadd(?=\()'), constant('msub')),
    ('sign', re.compile(r'\bmsub(?=\()'), constant('madd')),
    ('comparison', re.compile(r'(?<= )<(?= )'), constant('<=')),
    ('comparison', re.compile(r'(?<= )<=(?= )'), constant('<')),
    ('comparison', re.compile(r'(?<= )>(?= )'), constant('>=')),
    ('comparison', re.compile(r'(?<= )>=(?= )'), constant('>')),
    ('comparison', re.compile(r'(?<= )==(?= )'), constant('!=')),
    ('comparison', re.compile(r'(?<= )!=(?= )'), constant('==')),
    ('comparison', re.compile(r'(?<= )&&(?= )'), constant('||')),
    ('comparison', re.compile(r'(?<= )\|\|(?= )'), constant('&&')),
    ('constant', re.compile(r'(?<![\w.])\d+(?![\w.\'])'), changed_integer),
    ('constant', re.compile(r'(?<![\w.])\d+\.\d+(?![\w.])'), changed_decimal),
    ('index', re.compile(r'(?<=[\w)\]])\[([\w .>+*/-]+)\](?!\])'),
     next_element),
    # A whole assignment or call on a line of its own.
    ('statement', re.compile(r'(?<=[;{}]\n)[ ]+(?!return|break|continue|throw|goto|delete|co_)'
                             r'(?:[\w.>:\[\]()*-]+ (?:[-+*/|&^]?=) [^;{}\n]+|(?:\+\+|--)[\w.>-]+'
                             r'|[\w.>:-]+(?:<[\w, ]+>)?\([^;{}\n]*\));(?=\n)'),
     constant(';')),
]


def mutations_of(path, text):
    """All of them, in the order of the rules."""
    code = blanked(text)
    return [Mutation(path, match.start(), text[match.start():match.end()], new, kind)
            for kind, pattern, replacements in RULES
            for match in pattern.finditer(code)
            for new in replacements(match)]
