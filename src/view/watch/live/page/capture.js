// Pictures and videos of what is seen, made by the browser, as files.

let film = null;

function save(blob, ending) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = `planwright-${page.shown.t.toFixed(2)}s.${ending}`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

// To be called when the picture has just been drawn: it is gone when the browser has shown it.
function capture() {
  if (!page.wantsPicture) return;
  page.wantsPicture = false;
  canvas.toBlob((blob) => blob && save(blob, 'png'), 'image/png');
}

function toggleFilm() {
  if (film) {
    film.stop();
    return;
  }
  const kind = ['video/webm;codecs=vp9', 'video/webm', 'video/mp4'].find((one) => MediaRecorder.isTypeSupported(one));
  const pieces = [];
  film = new MediaRecorder(canvas.captureStream(30), { mimeType: kind, videoBitsPerSecond: 6e6 });
  film.addEventListener('dataavailable', ({ data }) => pieces.push(data));
  film.addEventListener('stop', () => {
    film = null;
    showFilm();
    save(new Blob(pieces, { type: kind }), kind.startsWith('video/mp4') ? 'mp4' : 'webm');
  });
  film.start(1000);
  // The past is filmed from where it stands to its end.
  if (page.time !== null && !page.isPlaying) play();
  showFilm();
  page.isDirty = true;
}

function showFilm() { $('film').setAttribute('aria-pressed', String(!!film)); }

const pictureButton = pushButton('picture', 'Save the picture as a PNG file', () => {
  page.wantsPicture = true;
  page.isDirty = true;
});
const filmButton = pushButton('film', 'Film what is seen until clicked again, or to the end of the run, and save it as a video', toggleFilm);
filmButton.id = 'film';
filmButton.disabled = !window.MediaRecorder || !canvas.captureStream;
$('tools').append(pictureButton, filmButton);
showFilm();
