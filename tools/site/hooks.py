"""What MkDocs does with the pages besides its own: anchors as GitHub makes them, and the style of wide tables."""
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

from check_links import slug  # noqa: E402


def on_config(config):
    config["mdx_configs"].setdefault("toc", {})["slugify"] = lambda text, separator: slug(text)
    return config


def on_post_build(config):
    style = pathlib.Path(config["site_dir"]) / "style"
    style.mkdir(exist_ok=True)
    (style / "site.css").write_text((ROOT / "tools/site/site.css").read_text())
