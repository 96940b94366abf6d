"""The tests; what several of them share asserts in pytest's words, too."""

import pytest

pytest.register_assert_rewrite("tests.browser", "tests.patience")
