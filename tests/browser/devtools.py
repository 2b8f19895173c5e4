"""A headless Chromium, driven over a pipe by its DevTools protocol."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import tempfile
from typing import Any


class Browser:
    """One page of a Chromium that lives as long as this.

    Parameters
    ----------
    program
        Its path.
    """

    def __init__(self, program: str) -> None:
        self.errors: list[str] = []  # what pages report: exceptions, errors of the console, dialogs
        self._folder = tempfile.TemporaryDirectory()
        reads, self._writes = os.pipe()
        self._reads, writes = os.pipe()
        options = ["--headless=new", "--no-sandbox", "--disable-gpu", "--remote-debugging-pipe", "--no-first-run",
                   "--disable-background-networking", "--window-size=1200,900", f"--user-data-dir={self._folder.name}"]
        self._process = subprocess.Popen(
            ["sh", "-c", f'exec "$@" 3<&{reads} 4>&{writes}', "sh", program, *options, "about:blank"],
            pass_fds=(reads, writes), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(reads)
        os.close(writes)
        self._text = b""
        self._number = 0
        self._session: str | None = None
        self._loaded = False
        pages = [each for each in self.call("Target.getTargets")["targetInfos"] if each["type"] == "page"]
        self._session = self.call("Target.attachToTarget", targetId=pages[0]["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.call(f"{domain}.enable")

    def close(self) -> None:
        """End it."""
        with contextlib.suppress(OSError, RuntimeError):
            self.call("Browser.close")
        self._process.wait(timeout=20)
        for end in (self._reads, self._writes):
            os.close(end)
        self._folder.cleanup()

    def call(self, method: str, **parameters: Any) -> dict[str, Any]:
        """Return the result of a command of the protocol."""
        self._number += 1
        message: dict[str, Any] = {"id": self._number, "method": method, "params": parameters}
        if self._session is not None and not method.startswith(("Target.", "Browser.")):
            message["sessionId"] = self._session
        os.write(self._writes, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._next()
            if answer.get("id") != self._number:
                self._take(answer)
            elif "error" in answer:
                raise RuntimeError(f"{method}: {answer['error']['message']}")
            else:
                return answer["result"]

    def _next(self) -> dict[str, Any]:
        while b"\0" not in self._text:
            more = os.read(self._reads, 1 << 16)
            if not more:
                raise RuntimeError("the browser has ended")
            self._text += more
        text, _, self._text = self._text.partition(b"\0")
        return json.loads(text)

    def _take(self, event: dict[str, Any]) -> None:
        name, of = event.get("method"), event.get("params", {})
        if name == "Page.loadEventFired":
            self._loaded = True
        elif name == "Runtime.exceptionThrown":
            self.errors.append(json.dumps(of["exceptionDetails"])[:500])
        elif name == "Runtime.consoleAPICalled" and of["type"] in ("error", "assert"):
            self.errors.append(json.dumps(of["args"])[:500])
        elif name == "Log.entryAdded" and of["entry"]["level"] == "error":
            self.errors.append(of["entry"]["text"])
        elif name == "Page.javascriptDialogOpening":
            self.errors.append(f"a dialog: {of['message']}")

    def open(self, path: str) -> None:
        """Load a file, and wait until it is drawn."""
        self._loaded = False
        self.call("Page.navigate", url=f"file://{path}")
        while not self._loaded:
            self._take(self._next())

    def value(self, expression: str) -> Any:
        """Return the value of a script."""
        found = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in found:
            raise RuntimeError(found["exceptionDetails"]["exception"]["description"])
        return found["result"].get("value")

    def move(self, x: float, y: float) -> None:
        """Move the pointer."""
        self.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)

    def click(self, x: float, y: float) -> None:
        """Click with the first button."""
        for kind in ("mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def key(self, name: str, text: str = "") -> None:
        """Press a key."""
        extra = {"text": text} if text else {}
        codes = {"Enter": 13, "ArrowRight": 39, "ArrowDown": 40}
        if name in codes:
            extra["windowsVirtualKeyCode"] = codes[name]
        self.call("Input.dispatchKeyEvent", type="keyDown", key=name, **extra)
        self.call("Input.dispatchKeyEvent", type="keyUp", key=name)
