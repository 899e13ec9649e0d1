//! The page of a report in a browser.

use std::fs;
use std::process::{Command, Stdio};

use resvg::tiny_skia::Pixmap;
use serde_json::Value;

use crate::report::{FAIRED, HULL, faired, text};
use crate::support::folder;

fn browser() -> Option<&'static str> {
    let names = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome"];
    names.into_iter().find(|name| {
        let asked = Command::new(name).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
        asked.is_ok_and(|status| status.success())
    })
}

/// Before the page: errors are kept. After it: every control is used, and the view is looked at after each.
const LISTEN: &str = "<script>window.faults = []; addEventListener('error', (e) => faults.push(e.message)); \
    console.error = (...words) => faults.push(words.join(' '));</script>";
const DRIVE: &str = "<pre id=\"driven\"></pre><script>(async () => {
  const canvas = document.getElementById('view'), gl = canvas.getContext('webgl');
  const wait = () => new Promise((done) => setTimeout(done, 100));
  const look = () => {
    const pixels = new Uint8Array(4 * canvas.width * canvas.height);
    gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    let sum = 0, dark = 0;
    for (let k = 0; k < pixels.length; k++) { sum = (sum * 31 + pixels[k]) >>> 0; if (pixels[k] < 200) dark++; }
    return [sum, dark / pixels.length];
  };
  const maps = () => ['gaussian', 'mean', 'zebra'].map((id) => document.getElementById(id).disabled);
  // Whether nothing is cut off by the edge of the view.
  const whole = () => {
    const [w, h] = [canvas.width, canvas.height];
    return [[0, 0, w, 1], [0, h - 1, w, 1], [0, 0, 1, h], [w - 1, 0, 1, h]].every(([x, y, dx, dy]) => {
      const pixels = new Uint8Array(4 * dx * dy);
      gl.readPixels(x, y, dx, dy, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
      return pixels.every((value) => value === 255);
    });
  };
  const states = [], open = maps();
  const note = async (name) => { await wait(); states.push([name, ...look()]); };
  await note('start');
  for (const id of ['station', 'waterline', 'buttock', 'diagonal', 'combs', 'gaussian', 'mean', 'zebra', 'surface', 'half']) {
    document.getElementById(id).click();
    await note(id);
  }
  const closed = maps();
  for (const button of document.querySelectorAll('[data-view]')) { button.click(); await note(button.dataset.view); }
  document.getElementById('body').click();
  await note('body');
  document.getElementById('station').click();
  await note('sections');
  const inside = whole();
  document.getElementById('before').click();
  await note('before');
  const head = document.querySelector('#changes th:nth-child(7) button'), column = () =>
    [...document.querySelectorAll('#changes tbody tr')].map((row) => Number(row.cells[6].textContent));
  head.click();
  const rising = column().every((value, k, all) => k === 0 || all[k - 1] <= value);
  head.click();
  const falling = column().every((value, k, all) => k === 0 || all[k - 1] >= value);
  document.getElementById('driven').textContent = JSON.stringify({
    states, faults, open, closed, inside, rising, falling, viewer: document.documentElement.dataset.viewer, figures: document.querySelectorAll('figure svg').length,
    wide: document.documentElement.scrollWidth <= innerWidth, outside: performance.getEntriesByType('resource').map((r) => r.name).filter((n) => !n.startsWith('data:')) });
})();</script>";

#[test]
fn the_page_works_in_a_browser() {
    let Some(browser) = browser() else {
        println!("skipped: there is no Chromium or Chrome to open the page in");
        return;
    };
    let path = folder("browser");
    let page = text(&faired().1, "report.html");
    let driven = page.replacen("<head>", &format!("<head>{LISTEN}"), 1).replace("</body>", &format!("{DRIVE}</body>"));
    fs::write(path.join("driven.html"), driven).unwrap();
    fs::write(path.join("report.html"), page).unwrap();
    let run = |more: &[&str], page: &str| {
        let address = format!("file://{}", path.join(page).display());
        let profile = format!("--user-data-dir={}", path.join("profile").display());
        let output = Command::new(browser)
            .args(["--headless=new", "--no-sandbox", "--disable-gpu-sandbox", "--use-angle=swiftshader"])
            .args(["--enable-unsafe-swiftshader", "--hide-scrollbars", "--window-size=1200,1000"])
            .args(["--virtual-time-budget=20000", &profile])
            .args(more)
            .arg(address)
            .stdin(Stdio::null())
            .output()
            .unwrap();
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    let document = run(&["--dump-dom"], "driven.html");
    let told = document.split("<pre id=\"driven\">").nth(1).and_then(|rest| rest.split("</pre>").next()).unwrap_or("");
    if !document.contains("<html") {
        println!("skipped: the browser did not run the page");
        return;
    }
    let told: Value =
        serde_json::from_str(&told.replace("&amp;", "&")).unwrap_or_else(|_| panic!("not driven: {told}"));
    assert_eq!(told["faults"], serde_json::json!([]));
    assert_eq!(told["viewer"], "drawn");
    assert_eq!(told["outside"], serde_json::json!([]), "the page asks for other files");
    assert_eq!((&told["rising"], &told["falling"], &told["wide"]), (&true.into(), &true.into(), &true.into()));
    // Maps can be chosen where there is a surface to paint them on.
    assert_eq!(
        (&told["open"], &told["closed"]),
        (&serde_json::json!([false, false, false]), &serde_json::json!([true, true, true]))
    );
    assert_eq!(told["inside"], true, "combs leave the body plan");
    // Tables stand on the page as text.
    assert_eq!(told["figures"], HULL.len() + FAIRED.len() - 9);
    let states = told["states"].as_array().unwrap();
    assert_eq!(states.len(), 18);
    for pair in states.windows(2) {
        // The view in space is the first one, and before differs by less than pixels on this table.
        let same = pair[1][0] == "before" || pair[1][0] == "space";
        assert!(pair[0][1] != pair[1][1] || same, "{} changes nothing: {told}", pair[1][0]);
    }
    assert!(states.iter().all(|state| state[2].as_f64().unwrap() > 0.001), "a view is blank: {told}");
    let shot = path.join("shot.png");
    run(&[&format!("--screenshot={}", shot.display())], "report.html");
    let picture = Pixmap::decode_png(&fs::read(shot).unwrap()).unwrap();
    let dark = picture.pixels().iter().filter(|pixel| pixel.red() < 128).count();
    assert!(dark > 2000, "{dark} dark pixels");
}
