# SPDX-License-Identifier: BSD-3-Clause
"""A headless Chromium, driven by selenium, for pages of reports. WebGL is SwiftShader's: drawn by the processor."""
import os
import shutil

from selenium import webdriver
from selenium.webdriver.chrome.service import Service


def missing():
    """The missing part; "": none."""
    return ", ".join(name for name in ("chromium", "chromedriver") if shutil.which(name) is None)


class Browser:
    """Size of the page in pixels; `options`: further words for Chromium."""

    def __init__(self, folder, width=1400, height=900, options=()):
        choice = webdriver.ChromeOptions()
        choice.binary_location = shutil.which("chromium")
        profile = self.profile = os.path.join(folder, "profile")
        for word in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--enable-unsafe-swiftshader", "--use-angle=swiftshader", "--hide-scrollbars", "--force-prefers-reduced-motion",
                     "--force-device-scale-factor=1", f"--user-data-dir={profile}", f"--window-size={width},{height}", *options):
            choice.add_argument(word)
        choice.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=choice)
        self.driver.set_script_timeout(300)
        self.driver.set_page_load_timeout(300)
        # The size of the visible part, whatever the window has around it.
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.driver.quit()

    def open(self, path):
        """Waits until the view is there. False: the page has none."""
        self.driver.get("file://" + path)
        return self.wait("const viewer = await carreauReport.ready; window.viewer = viewer; return viewer !== null;")

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def wait(self, script, *arguments):
        """The result of the body of an asynchronous function."""
        whole = ("const done = arguments[arguments.length - 1];"
                 "(async (...given) => {" + script + "})(...[...arguments].slice(0, -1)).then((x) => done([x]), (e) => done({ error: String(e) }));")
        result = self.driver.execute_async_script(whole, *arguments)
        if isinstance(result, dict):
            raise RuntimeError(result["error"])
        return result[0]

    def frames(self, n=2):
        """Waits until n pictures have been drawn."""
        self.wait("for (let i = 0; i < given[0]; ++i) await new Promise(requestAnimationFrame);", n)

    def processor_seconds(self):
        """Processor time of all processes of this browser so far."""
        total = 0
        for number in filter(str.isdigit, os.listdir("/proc")):
            try:
                with open(f"/proc/{number}/cmdline", "rb") as file:
                    own = self.profile.encode() in file.read()
                if own:
                    with open(f"/proc/{number}/stat") as file:
                        fields = file.read().rsplit(")", 1)[1].split()
                    total += int(fields[11]) + int(fields[12])
            except OSError:
                pass  # it has ended
        return total / os.sysconf("SC_CLK_TCK")

    def messages(self):
        return [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] in ("SEVERE", "WARNING")]

    def shot(self, path):
        self.driver.save_screenshot(path)
