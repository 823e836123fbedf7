# SPDX-License-Identifier: GPL-3.0-or-later
"""What MkDocs calls as it makes the site (mkdocs.yml): the version, and files of the project that documents link to."""

from site_commands import options
from site_files import ROOT, SitePages

from bridge_demolition_addon.version import VERSION

SHIM = "site_assets/iframe-worker.js"
PAGES = SitePages(ROOT)
ALL_VERSIONS = "all-versions"
"""Stands for the link to the page of all versions, until a page knows how deep it lies."""


def on_config(config):
    """Show the version in the head and at the foot of each page, and look for no script elsewhere."""
    config.site_name += f" {VERSION}"
    others = f' <a href="{ALL_VERSIONS}">All versions</a>.' if config.extra["among_others"] else ""
    config.copyright = f"Version {VERSION}.{others} Licence: GPL-3.0-or-later, without warranty."
    config.extra["polyfills"] = [SHIM]
    return config


def on_files(files, config):
    """Add a page for each file of the project that the documents lead to."""
    from mkdocs.structure.files import File

    files.append(File.generated(config, SHIM, abs_src_path=str(ROOT / "scripts" / SHIM)))
    for place, text in PAGES.made().items():
        files.append(File.generated(config, place, content=text))
    return files


def on_page_markdown(markdown, page, config, files):
    """Lead links out of the documents to the pages made for them, and give the page of the commands their options."""
    if page.file.src_uri == "commands.md":
        markdown += options()
    source = ROOT / "docs" / page.file.src_uri
    return PAGES.led(markdown, source) if source.is_file() else markdown


def on_post_page(output, page, config):
    """Lead to the page of all versions, which is beside the folder of this one."""
    return output.replace(f'href="{ALL_VERSIONS}"', f'href="{"../" * (1 + page.url.count("/"))}index.html"')
