"""The form that asks a person for the access token."""

from __future__ import annotations

import html

_FORM = """<!doctype html>
<html lang="en">
<head>
  <meta charset="utf-8">
  <title>heli2dof: access</title>
  <meta name="viewport" content="width=device-width, initial-scale=1">
  <meta name="color-scheme" content="light dark">
  <link rel="icon" href="{static}favicon.svg" type="image/svg+xml">
  <link rel="stylesheet" href="{static}css/login.css">
</head>
<body>
  <main>
    <h1><img src="{static}favicon.svg" alt="" width="24" height="24"> heli2dof</h1>
    <form method="post">
      <label for="token">Access token</label>
      <input id="token" name="token" type="password" required autofocus autocomplete="current-password"{wrong}>
      {message}
      <button>Open</button>
    </form>
    <p>Whoever runs this server, as your instructor, has the token.</p>
  </main>
</body>
</html>
"""
_WRONG = '<p id="wrong" class="wrong" role="alert">This is not the token.</p>'


def login_form(*, wrong: bool, root: str, path: str) -> str:
    """The page.

    Args:
        wrong: whether another token was tried.
        root: prefix of the app's addresses, as far as it is known.
        path: that was asked for, with the prefix; the form's own files are found relative to it.
    """
    depth = path.removeprefix(root).count("/") - 1
    return _FORM.format(
        static=html.escape("../" * max(depth, 0) + "static/"),
        wrong=' aria-invalid="true" aria-describedby="wrong"' if wrong else "",
        message=_WRONG if wrong else "",
    )
