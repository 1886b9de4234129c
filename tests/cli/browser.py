# SPDX-License-Identifier: MPL-2.0
"""A page in headless Chromium, drawn by its software renderer, driven by the DevTools protocol over a pipe."""

import base64
import json
import os
import select
import subprocess
import time

from needs import CHROMIUM


class Browser:
    """with Browser(url, folder) as page: the page is loaded, 800 x 600."""

    def __init__(self, url, folder, size=(800, 600)):
        command_in, self.to = os.pipe()
        self.answers, answer_out = os.pipe()

        def take_pipe():  # Chromium reads descriptor 3 and writes 4
            a, b = os.dup(command_in), os.dup(answer_out)
            os.dup2(a, 3)
            os.dup2(b, 4)

        self.process = subprocess.Popen(
            [CHROMIUM, "--headless=new", "--no-sandbox", "--disable-gpu-sandbox",
             "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--remote-debugging-pipe",
             f"--window-size={size[0]},{size[1]}", f"--user-data-dir={folder / 'profile'}", "about:blank"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, preexec_fn=take_pipe, close_fds=False)
        os.close(command_in)
        os.close(answer_out)
        self.number, self.data, self.console, self.session = 0, b"", [], None
        target = next(t for t in self.call("Target.getTargets")["targetInfos"] if t["type"] == "page")
        self.session = self.call("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        self.call("Runtime.enable")
        self.call("Log.enable")
        self.call("Emulation.setDeviceMetricsOverride", width=size[0], height=size[1], deviceScaleFactor=1,
                  mobile=False)
        self.call("Page.navigate", url=url)

    def __enter__(self):
        return self

    def __exit__(self, *ignored):
        try:
            self.session = None
            self.call("Browser.close")
            self.process.wait(20)
        except (OSError, RuntimeError, subprocess.TimeoutExpired):
            self.process.kill()
            self.process.wait()
        os.close(self.to)
        os.close(self.answers)

    def call(self, method, **params):
        self.number += 1
        message = {"id": self.number, "method": method, "params": params}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.to, json.dumps(message).encode() + b"\0")
        end = time.monotonic() + 120
        while True:
            if b"\0" not in self.data:
                if not select.select([self.answers], [], [], max(0, end - time.monotonic()))[0]:
                    raise RuntimeError(f"{method}: no answer")
                more = os.read(self.answers, 1 << 20)
                if not more:
                    raise RuntimeError("Chromium has ended")
                self.data += more
                continue
            text, self.data = self.data.split(b"\0", 1)
            answer = json.loads(text)
            if answer.get("method") in ("Runtime.consoleAPICalled", "Runtime.exceptionThrown", "Log.entryAdded"):
                if b"GPU stall" not in text:  # the page waits for the end of a drawing to time it
                    self.console.append(text.decode())
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]

    def evaluate(self, expression):
        return self.call("Runtime.evaluate", expression=expression, returnByValue=True,
                         awaitPromise=True)["result"].get("value")

    def wait(self, expression, seconds=60):
        end = time.monotonic() + seconds
        while not self.evaluate(expression):
            if time.monotonic() > end:
                raise RuntimeError(f"never: {expression}; console: {self.console}")
            time.sleep(0.1)

    def turn(self, seconds):
        """Drags the mouse to and fro; frames drawn and their intervals [ms]."""
        self.evaluate("""window.times ? 0 : new MutationObserver(() => window.times.push(performance.now()))
            .observe(document.body, {attributeFilter: ['data-drawn']}); window.times = []; 0""")
        self.call("Input.dispatchMouseEvent", type="mousePressed", x=500, y=300, button="left", clickCount=1)
        begin, n = time.monotonic(), 0
        while time.monotonic() - begin < seconds:
            n += 1
            x = 500 + 200 * (1 - abs((n % 200) / 100 - 1))
            self.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=300, button="left", buttons=1)
            time.sleep(0.005)
        self.call("Input.dispatchMouseEvent", type="mouseReleased", x=x, y=300, button="left", clickCount=1)
        times = self.evaluate("window.times")
        return [b - a for a, b in zip(times, times[1:])]

    def picture(self, path):
        path.write_bytes(base64.b64decode(self.call("Page.captureScreenshot")["data"]))
