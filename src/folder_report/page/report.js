"use strict";
// Pointing at a drawing reads the nearest of its points.
(() => {
  const value = document.getElementById("value");

  /** What stands at a place of an axis. */
  const number = (axis, at) => {
    if (axis.names) return (axis.names[Math.round(at)] ?? "").replaceAll("\n", " ");
    if (axis.scale === "linear") return String(Number(at.toPrecision(5)));
    if (axis.scale === "binary" && Math.abs(at) < 20) return String(Number((2 ** at).toPrecision(5)));
    const power = axis.scale === "falling" ? -at : axis.scale === "binary" ? at * Math.log10(2) : at;
    // Beyond the range of doubles, too.
    let exponent = Math.floor(power), leading = (10 ** (power - exponent)).toFixed(2);
    if (leading === "10.00") [leading, exponent] = ["1.00", exponent + 1];
    return -4 < exponent && exponent < 5 ? String(Number((10 ** power).toPrecision(3))) : `${leading}e${exponent}`;
  };

  const nearest = (figure, x, y) => {
    let best = null, least = 24;
    for (const panel of figure.panels) {
      const [left, top, width, height] = panel.box;
      for (const curve of panel.curves)
        for (const point of curve.points) {
          const px = left + ((point[0] - panel.x.from) / (panel.x.to - panel.x.from)) * width;
          const py = top + height - ((point[1] - panel.y.from) / (panel.y.to - panel.y.from)) * height;
          const distance = Math.hypot(px - x, py - y);
          if (distance < least) [least, best] = [distance, { panel, curve, point, px, py }];
        }
    }
    return best;
  };

  for (const drawing of document.querySelectorAll(".drawing")) {
    const data = drawing.querySelector("script"), picture = drawing.querySelector("img");
    if (!data || !picture) continue;
    const figure = JSON.parse(data.textContent);
    const mark = document.createElement("span");
    mark.className = "mark";
    mark.hidden = true;
    picture.after(mark);
    const hide = () => {
      value.hidden = mark.hidden = true;
    };
    const show = (event) => {
      const box = picture.getBoundingClientRect(), scale = figure.size[0] / box.width;
      const found = nearest(figure, (event.clientX - box.left) * scale, (event.clientY - box.top) * scale);
      if (!found) return hide();
      const { panel, curve, point } = found;
      const lines = [curve.label, `${panel.x.label || "x"}: ${number(panel.x, point[0])}`,
                     `${panel.y.label || "y"}: ${number(panel.y, curve.value ?? point[1])}`];
      value.textContent = lines.filter((line) => line).join("\n");
      value.hidden = mark.hidden = false;
      const room = document.documentElement;
      value.style.left = `${Math.max(4, Math.min(event.clientX + 14, room.clientWidth - value.offsetWidth - 4))}px`;
      value.style.top = `${Math.max(4, Math.min(event.clientY + 14, room.clientHeight - value.offsetHeight - 4))}px`;
      mark.style.left = `${found.px / scale}px`;
      mark.style.top = `${found.py / scale}px`;
    };
    picture.addEventListener("pointermove", show);
    picture.addEventListener("pointerdown", show);
    picture.addEventListener("pointerleave", hide);
  }
})();
