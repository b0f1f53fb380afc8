"""What calls of Lozenge raise: a class for each exit code of the command."""


class Error(RuntimeError):
    """Anything that an input, an option or the system can cause. `code` is the exit code of the command `lozenge`; the message
    names what is wrong, where, and what to do."""

    code = 1


class InternalError(Error):
    """Lozenge's own fault."""


class UsageError(Error, ValueError):
    """An argument makes no sense."""

    code = 2


class UnusableInputError(Error, ValueError):
    """The input is broken: truncated, inconsistent, not finite, empty."""

    code = 3


class UnsupportedError(Error):
    """The input is sound, but needs what Lozenge doesn't do."""

    code = 4


class LimitError(Error):
    """A limit on size, memory or time was reached."""

    code = 5


class RefusedError(Error, OSError):
    """The system refuses: a full disk, a place that may not be written."""

    code = 6
