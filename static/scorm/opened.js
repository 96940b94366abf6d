/**
 * Where this page was opened from a folder, browsers load no modules: says so, and what to do. A plain script, which is
 * loaded even then.
 */
if (location.protocol === 'file:') document.documentElement.classList.add('from-folder');
