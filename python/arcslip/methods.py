"""The studies of a scene as methods."""

from .studies import add_methods


class StudyMethods:
    """A method for each kind of study, made from its keys."""

    __slots__ = ()


add_methods(StudyMethods)
