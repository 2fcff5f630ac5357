'use strict';

/// One play of the motion in an inner page as a video, which the browser encodes; pausing there ends it.
/// Resolves to a Blob, or to null where the browser records no video.
async function filmOf(page) {
  const kind = ['video/webm', 'video/mp4'].find((name) => window.MediaRecorder?.isTypeSupported(name));
  if (!kind) return null;
  const find = (id) => page.getElementById(id), stage = page.querySelector('#stage canvas');
  const slider = find('slider'), play = find('play'), canvas = document.createElement('canvas');
  // Some encoders take even sizes alone.
  [canvas.width, canvas.height] = [stage.width & ~1, stage.height & ~1];
  const pen = canvas.getContext('2d'), style = page.defaultView.getComputedStyle(page.body);
  const draw = () => {
    pen.fillStyle = style.backgroundColor;
    pen.fillRect(0, 0, canvas.width, canvas.height);
    pen.drawImage(stage, 0, 0);
    pen.fillStyle = style.color;
    pen.font = `${Math.round(canvas.width / 36)}px ${style.fontFamily}`;
    pen.fillText(find('time').textContent, 8, canvas.width / 30);
  };
  slider.value = 0;
  slider.dispatchEvent(new Event('input'));
  draw();
  const recorder = new MediaRecorder(canvas.captureStream(30), {mimeType: kind}), parts = [];
  recorder.ondataavailable = ({data}) => parts.push(data);
  const ended = new Promise((end) => { recorder.onstop = end; });
  recorder.start();
  play.click();
  let before = 0;
  const step = () => {
    draw();
    const now = Number(slider.value);
    // At the end, paused, or begun again
    if (now === Number(slider.max) || play.textContent === 'play' || now < before) return recorder.stop();
    before = now;
    requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
  await ended;
  return new Blob(parts, {type: kind});
}
