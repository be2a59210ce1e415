"""Documents in the manner of what people publish, written before their author had read a line of runtime/ (issue 13).

Like the documents of ../blind they are what is tested: they are not changed so that a test passes. robots.py has the manner of ROS and
CAD, modellers.py that of modelling programs, games.py that of games and of files that went
through many hands, studios.py and buildings.py that of programs that these leave out.
"""
from . import buildings, games, modellers, robots, studios  # noqa: F401
from .writer import DOCUMENTS, write  # noqa: F401
