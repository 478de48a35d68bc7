// Search runs in a worker. Browsers start none from a file; there a hidden frame takes its place.
class FrameWorker extends EventTarget {
  constructor(url) {
    super();
    this.frame = document.createElement("iframe");
    this.frame.hidden = true;
    document.body.append(this.frame);
    this.frame.contentDocument.open(); // else some browsers exchange the empty page later
    this.frame.contentDocument.write("<!doctype html><title>Search</title>");
    this.frame.contentDocument.close();
    this.inside = this.frame.contentWindow;
    this.inside.postMessage = (data) => {
      const event = new MessageEvent("message", { data });
      this.dispatchEvent(event);
      this.onmessage?.(event);
    };
    this.inside.importScripts = (...urls) =>
      urls.reduce((before, each) => before.then(() => this.load(each)), Promise.resolve());
    this.started = this.load(url);
  }

  load(url) {
    return new Promise((resolve, reject) => {
      const script = this.frame.contentDocument.createElement("script");
      Object.assign(script, { src: url, onload: resolve, onerror: reject });
      this.frame.contentDocument.documentElement.append(script);
    });
  }

  postMessage(data) {
    this.started.then(() =>
      this.inside.dispatchEvent(new this.inside.MessageEvent("message", { data })),
    );
  }

  terminate() {
    this.frame.remove();
  }
}

if (location.protocol === "file:") window.Worker = FrameWorker;
