// Shows the values of the pixel under the cursor: as drawn, and of the reference.
"use strict";
const tip = document.createElement("div");
tip.className = "tip";
tip.hidden = true;
document.body.append(tip);

const pixels = new WeakMap();
function pixel(image, x, y) {
  if (!pixels.has(image)) {
    const canvas = document.createElement("canvas");
    canvas.width = image.naturalWidth;
    canvas.height = image.naturalHeight;
    const context = canvas.getContext("2d", { willReadFrequently: true });
    context.drawImage(image, 0, 0);
    pixels.set(image, context);
  }
  return Array.from(pixels.get(image).getImageData(x, y, 1, 1).data.slice(0, 3)).join(" ");
}

for (const section of document.querySelectorAll("section")) {
  const reference = section.querySelector("img.reference");
  for (const card of section.querySelectorAll(".card")) {
    const drawn = card.querySelector("img");
    for (const image of card.querySelectorAll("img")) {
      image.addEventListener("pointermove", (event) => {
        const box = image.getBoundingClientRect();
        const x = Math.floor(((event.clientX - box.left) / box.width) * image.naturalWidth);
        const y = Math.floor(((event.clientY - box.top) / box.height) * image.naturalHeight);
        // The picture of differences has a legend below.
        tip.hidden = x < 0 || y < 0 || x >= drawn.naturalWidth || y >= drawn.naturalHeight;
        if (tip.hidden) return;
        tip.textContent = `column ${x}, row ${y}: ${pixel(drawn, x, y)}; reference ${pixel(reference, x, y)}`;
        tip.style.left = `${Math.min(event.clientX + 12, window.innerWidth - tip.offsetWidth - 8)}px`;
        tip.style.top = `${event.clientY + 16}px`;
      });
      image.addEventListener("pointerleave", () => { tip.hidden = true; });
    }
  }
}
