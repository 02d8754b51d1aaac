"""A page in headless Chromium: which pictures are missing, and what its scripts complain about."""

import html
import json
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

# Runs in a copy of the page beside it, after everything has loaded.
PROBE = """
<script>
  window.complaints = [];
  window.addEventListener("error", e => complaints.push(e.message || "cannot load " + (e.target.src || "")), true);
</script>
"""
# All pictures have loaded or failed by then: the copy has none that wait until they are scrolled to.
RESULT = """
<script>
  window.addEventListener("load", () => {
    const missing = [...document.images].filter(i => i.naturalWidth === 0).map(i => i.getAttribute("src"));
    const found = {missing: missing, complaints: complaints, pictures: document.images.length,
                   text: document.body.innerText.length};
    const note = document.createElement("pre");
    note.id = "probe";
    note.textContent = JSON.stringify(found);
    document.body.appendChild(note);
  });
</script>
"""


def find():
    """The browser's path, or None."""
    return shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


def look(path):
    """What the browser finds on a page: lists `missing` and `complaints`, counts `pictures` and `text`."""
    text = path.read_text().replace('loading="lazy"', "")
    head = text.find("<head>") + len("<head>") if "<head>" in text else 0
    probed = text[:head] + PROBE + text[head:] + RESULT
    with tempfile.NamedTemporaryFile("w", dir=path.parent, prefix=".probe-", suffix=".html") as copy:
        copy.write(probed)
        copy.flush()
        with tempfile.TemporaryDirectory() as profile:
            command = [find(), "--headless", "--no-sandbox", "--disable-gpu"]
            command += [f"--user-data-dir={profile}", "--dump-dom", Path(copy.name).as_uri()]
            done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    found = re.search(r'<pre id="probe">(.*?)</pre>', done.stdout, re.DOTALL)
    if not found:
        raise RuntimeError(f"{path}: the browser did not finish\n{done.stderr[-2000:]}")
    return json.loads(html.unescape(found[1]))
