"""What the scripts of the program share: their options, and how they end."""

import argparse
import signal
import sys


class Parser(argparse.ArgumentParser):
    """The first paragraph of `words` is its description. Bad options end the script with 1, as bad input does in all of mortise: 2 is
    a check that fails."""

    def __init__(self, words, **more):
        super().__init__(description=words.split("\n\n")[0], **more)

    def exit(self, status=0, message=None):
        super().exit(min(status, 1), message)


def run(main):
    """Without a traceback where the user or the reader of what is printed leaves."""
    for end in (signal.SIGINT, signal.SIGPIPE):
        signal.signal(end, signal.SIG_DFL)
    sys.exit(main())
